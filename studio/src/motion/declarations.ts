/** What a recording says of itself, by name: must be shown wherever its motion is. */
export type Declarations = Readonly<Record<string, string>>

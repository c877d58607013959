/** What a recording says of itself, by name: must be shown wherever its motion is. */
export type Declarations = Readonly<Record<string, string>>

/** What recordings declare that are no signing, such as those of the demo. */
export const kPlaceholder = 'signweave:placeholder'
export const isPlaceholder = (declarations: Declarations): boolean => kPlaceholder in declarations

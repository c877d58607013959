/** What a recording declares about itself, by name: must be shown wherever its motion is. */
export type Declarations = Readonly<Record<string, string>>

/** Declared by recordings that are not signing, such as those of the demo. */
export const kPlaceholder = 'signweave:placeholder'
export const isPlaceholder = (declarations: Declarations): boolean => kPlaceholder in declarations

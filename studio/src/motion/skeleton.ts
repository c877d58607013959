/** A joint of a skeleton. */
export interface Joint {
  readonly name: string
  /** Index of the parent, which precedes it; −1 for the root. */
  readonly parent: number
  /** From the parent, in metres, Y up, right-handed. */
  readonly offset: readonly [number, number, number]
}

/** The properties common to all frames of a motion. */
export interface Skeleton {
  /** Parents before children. */
  readonly joints: readonly Joint[]
  /** Joints with a translation in every frame, which replaces their offset, in the order of a frame's bytes. */
  readonly translated: readonly number[]
  /** Names of the scalar tracks (face weights), in the order of a frame's bytes. */
  readonly tracks: readonly string[]
}

/** The position of a part of the body: a joint, or a tip, which is an offset (metres) from its joint. */
export interface RigPart {
  readonly joint: number
  readonly offset?: readonly [number, number, number]
}

/** Maps parts to joints, by the names of docs/rig.md, such as `left_hand` or `right_index_tip`. */
export type Rig = { readonly [part: string]: RigPart | undefined }

/** Returns the joints from the root to `joint`, both included. */
export function chainTo(skeleton: Skeleton, joint: number): number[] {
  const chain: number[] = []
  for (let j = joint; j >= 0; j = skeleton.joints[j].parent) chain.unshift(j)
  return chain
}

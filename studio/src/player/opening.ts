import type { MotionSource } from '../motion/source'
import type { Strand } from '../viewer/showing'

/** Motions that are opened together, in one character's joints, and given up together. */
export class Opening {
  private readonly sources: MotionSource[] = []

  constructor(readonly character: string | undefined, private readonly onFault: (fault: Error) => void,
              private readonly onProgress: (source: MotionSource) => void) {}

  async strand(role: Strand['role'], source: MotionSource): Promise<Strand> {
    this.sources.push(source)
    source.onFault = this.onFault
    source.onProgress = () => this.onProgress(source)
    return { role, source, motion: await source.open() }
  }

  close(): void {
    for (const source of this.sources) source.close()
  }
}

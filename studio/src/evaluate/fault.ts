/** A fault detected by these pages rather than by the server, named by the key of its message. */
export class PageFault extends Error {
  constructor(readonly kind: 'noEvaluation' | 'noStudy' | 'noSpans' | 'noStorage' | 'otherStudy') {
    super(kind)
  }
}

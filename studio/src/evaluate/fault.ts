/** What is no fault of the server: told in the words of this folder's pages, by its key. */
export class PageFault extends Error {
  constructor(readonly kind: 'noEvaluation' | 'noStudy' | 'noSpans' | 'noStorage' | 'otherStudy') {
    super(kind)
  }
}

/** How much of a name's end tells it from its neighbours, in characters; the ending of a file comes on top. */
export const kTelling = 8
/** A name that is not much longer is not worth being parted. */
const kShort = 4

export interface NameParts {
  readonly begin: string
  /** What is always shown. */ readonly end: string
}

/** A name as its begin, which may be cut, and its end, which tells it from others: `bulletin-` and `meteo-12`. */
export function nameParts(name: string, telling = kTelling): NameParts {
  const letters = [...new Intl.Segmenter().segment(name)].map(({ segment }) => segment)
  const ending = /(?:\.[A-Za-z][A-Za-z0-9]{0,6}){1,2}$/.exec(name)?.[0].length ?? 0
  const most = telling + ending
  if (letters.length <= most + kShort) return { begin: name, end: '' }
  const at = letters.length - most
  const from = /^[-_ .]/.test(letters[at]) ? at + 1 : at // what stands between words tells nothing
  return { begin: letters.slice(0, from).join(''), end: letters.slice(from).join('') }
}

/** The number of characters at a name's end that distinguish it from its neighbours, excluding a file extension. */
export const kTelling = 8
/** A name that exceeds the limit by this little is not split. */
const kShort = 4

export interface NameParts {
  readonly begin: string
  /** The part that is always shown. */ readonly end: string
}

/** Splits a name into its begin, which may be cut, and its distinctive end: `bulletin-` and `meteo-12`. */
export function nameParts(name: string, telling = kTelling): NameParts {
  const letters = [...new Intl.Segmenter().segment(name)].map(({ segment }) => segment)
  const extension = /(?:\.[A-Za-z][A-Za-z0-9]{0,6}){1,2}$/.exec(name)?.[0].length ?? 0
  const most = telling + extension
  if (letters.length <= most + kShort) return { begin: name, end: '' }
  const at = letters.length - most
  const from = /^[-_ .]/.test(letters[at]) ? at + 1 : at // separators are not distinctive
  return { begin: letters.slice(0, from).join(''), end: letters.slice(from).join('') }
}

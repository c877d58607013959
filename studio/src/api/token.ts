/** The token that a server asks for. It is kept until the page is closed, also over a reload, and stands in no address that one sees. */

const kKey = 'signweave.token'

/** Only where somebody looks for it: a browser may keep nothing. */
type Kept = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>

export function keptToken(kept: Kept = sessionStorage): string {
  try {
    return kept.getItem(kKey) ?? ''
  } catch {
    return ''
  }
}

export function keepToken(token: string, kept: Kept = sessionStorage): void {
  try {
    if (token) kept.setItem(kKey, token)
    else kept.removeItem(kKey)
  } catch {
    // It is known until a reload, then.
  }
}

/** The token of a link such as `…/?token=TOKEN#/demo`, and the address without it. */
export function tokenIn(address: string): { readonly token?: string; readonly rest: string } {
  const url = new URL(address)
  const token = url.searchParams.get('token') ?? undefined
  url.searchParams.delete('token')
  return { token, rest: url.href }
}

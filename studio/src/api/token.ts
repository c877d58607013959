/** The token that a server requires. It is stored until the page is closed, survives a reload, and never appears in a visible address. */

const kKey = 'signweave.token'

/** Accessed only when needed: a browser may refuse storage. */
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
    // In that case it is known until the next reload.
  }
}

/** Returns the token of a link such as `…/?token=TOKEN#/demo`, and the address without it. */
export function tokenIn(address: string): { readonly token?: string; readonly rest: string } {
  const url = new URL(address)
  const token = url.searchParams.get('token') ?? undefined
  url.searchParams.delete('token')
  return { token, rest: url.href }
}

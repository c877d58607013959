/** Expensive resources shared by many users, such as the geometry of a body: created once, disposed when the last user has released them. */
export class Shared<T extends { dispose(): void }> {
  private readonly all = new Map<string, { readonly thing: T; users: number }>()

  take(key: string, make: () => T): T {
    let one = this.all.get(key)
    if (!one) this.all.set(key, (one = { thing: make(), users: 0 }))
    ++one.users
    return one.thing
  }

  leave(key: string): void {
    const one = this.all.get(key)
    if (!one || --one.users > 0) return
    this.all.delete(key)
    one.thing.dispose()
  }
}

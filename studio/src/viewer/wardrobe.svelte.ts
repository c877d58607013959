import type { CharacterRow } from '../api/schema'
import type { Api } from '../api/client'
import { preferences } from '../ui/preferences.svelte'
import type { CharacterModel } from './character_model'

/** The name of the studio's plain body, available for any skeleton. */
export const kDrawn = 'drawn'

/** The bodies to choose from: the server's characters, and the plain body. */
export class Wardrobe {
  /** Empty until the server has answered, or if it has none. */
  characters = $state.raw<readonly CharacterRow[]>([])
  private asked?: Promise<void>
  private readonly models = new Map<string, Promise<CharacterModel>>()

  constructor(private readonly api: Api) {}

  /** Resolves with the chosen character once the available ones are known; rejects if the server does not answer. */
  async ask(): Promise<string | undefined> {
    this.asked ??= this.api.characters().then((characters) => void (this.characters = characters))
    this.asked.catch(() => (this.asked = undefined)) // to be retried on the next call
    await this.asked
    return this.chosen
  }

  /** The chosen character's name; undefined if the plain body was chosen, or if there is no character. */
  get chosen(): string | undefined {
    const { body } = preferences
    if (body === kDrawn) return undefined
    return (this.characters.find(({ name }) => name === body) ?? this.characters[0])?.name
  }

  /** All choices, in the order of the list. */
  get all(): readonly string[] {
    return [...this.characters.map(({ name }) => name), kDrawn]
  }

  /** Returns a character's model, fetched once. */
  model(name: string): Promise<CharacterModel> {
    let model = this.models.get(name)
    if (!model) {
      // The GLB loader is not part of the page's first script.
      model = Promise.all([import('./character_model'), this.api.character(name)]).then(([{ CharacterModel }, glb]) => CharacterModel.load(glb))
      this.models.set(name, model)
      model.catch(() => this.models.delete(name)) // to be retried on the next call
    }
    return model
  }
}

import type { CharacterRow } from '../api/answers'
import type { Api } from '../api/client'
import { preferences } from '../ui/preferences.svelte'
import type { CharacterModel } from './character_model'

/** The name of the body that the studio draws itself, for any skeleton. */
export const kDrawn = 'drawn'

/** Who can sign: the server's characters, and the drawn body. */
export class Wardrobe {
  /** Empty until the server has told, or where it has none. */
  characters = $state.raw<readonly CharacterRow[]>([])
  private asked?: Promise<void>
  private readonly models = new Map<string, Promise<CharacterModel>>()

  constructor(private readonly api: Api) {}

  /** Resolves with the chosen character, once it is known who there is; rejects where the server does not tell. */
  async ask(): Promise<string | undefined> {
    this.asked ??= this.api.characters().then((characters) => void (this.characters = characters))
    this.asked.catch(() => (this.asked = undefined)) // to be tried again when asked again
    await this.asked
    return this.chosen
  }

  /** The chosen character's name; none where the drawn body was chosen, or there is no character. */
  get chosen(): string | undefined {
    const { body } = preferences
    if (body === kDrawn) return undefined
    return (this.characters.find(({ name }) => name === body) ?? this.characters[0])?.name
  }

  /** Everybody who can be chosen, in the order of the list. */
  get all(): readonly string[] {
    return [...this.characters.map(({ name }) => name), kDrawn]
  }

  /** A character's surfaces, fetched once. */
  model(name: string): Promise<CharacterModel> {
    let model = this.models.get(name)
    if (!model) {
      // What reads GLB is not in the page's first script.
      model = Promise.all([import('./character_model'), this.api.character(name)]).then(([{ CharacterModel }, glb]) => CharacterModel.load(glb))
      this.models.set(name, model)
      model.catch(() => this.models.delete(name)) // to be tried again when asked for again
    }
    return model
  }
}

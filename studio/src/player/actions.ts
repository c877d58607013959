import { annotationNear, nextBegin, type Tier } from '../annotation/document'
import type { Action } from '../ui/keys'
import { preferences } from '../ui/preferences.svelte'
import { kViews, type View } from '../viewer/camera'
import type { Transport } from '../viewer/transport'
import { kDrawn, type Wardrobe } from '../viewer/wardrobe.svelte'

/** The objects on which the keys and buttons of a player act. */
export interface ActedOn {
  readonly transport: Transport
  /** The tier used to find signs, and the annotation time of frame 0. */
  readonly tier?: Tier
  readonly originMs: number
  readonly viewer?: {
    look(view: View): void
    orbit(azimuth: number, elevation: number): void
    zoom(factor: number): void
    toggleTrails(): void
    toggleBones(): void
  }
  readonly timeline?: { zoom(factor: number): void; fit(): void }
  readonly wardrobe: Wardrobe
  readonly fullscreen: () => void
}

const kTurn = Math.PI / 24

/** Performs the action of a key or a button of a player. */
export function act(action: Action, { transport, tier, originMs, viewer, timeline, wardrobe, fullscreen }: ActedOn): void {
  const ms = transport.time * 1000 + originMs
  const jump = (direction: 1 | -1) => {
    const begin = tier && nextBegin(tier, ms, direction)
    if (begin !== undefined) transport.seek((begin - originMs) / 1000)
  }
  switch (action) {
    case 'play':
      if (transport.playing) transport.pause()
      else transport.play()
      break
    case 'back':
      transport.step(-1)
      break
    case 'on':
      transport.step(1)
      break
    case 'leapBack':
      transport.step(-10)
      break
    case 'leapOn':
      transport.step(10)
      break
    case 'signBefore':
      jump(-1)
      break
    case 'signAfter':
      jump(1)
      break
    case 'begin':
      transport.seek(transport.loop?.begin ?? 0)
      break
    case 'end':
      transport.seek(transport.loop?.end ?? transport.duration)
      break
    case 'slower':
      transport.setSpeed(transport.speed - (transport.speed > 0.5 ? 0.25 : 0.1))
      break
    case 'faster':
      transport.setSpeed(transport.speed + (transport.speed >= 0.5 ? 0.25 : 0.1))
      break
    case 'repeat':
      transport.repeat = !transport.repeat
      break
    case 'select': {
      const sign = tier && annotationNear(tier, ms)
      if (sign) {
        transport.setLoop((sign.begin - originMs) / 1000, (sign.end - originMs) / 1000)
        if (ms < sign.begin || ms >= sign.end) transport.seek((sign.begin - originMs) / 1000)
      }
      break
    }
    case 'loopBegin':
      transport.setLoop(transport.time, transport.loop?.end ?? transport.duration)
      break
    case 'loopEnd':
      transport.setLoop(transport.loop?.begin ?? 0, transport.time)
      break
    case 'clear':
      transport.loop = null
      break
    case 'orbitLeft':
      viewer?.orbit(-kTurn, 0)
      break
    case 'orbitRight':
      viewer?.orbit(kTurn, 0)
      break
    case 'orbitUp':
      viewer?.orbit(0, kTurn)
      break
    case 'orbitDown':
      viewer?.orbit(0, -kTurn)
      break
    case 'nearer':
      viewer?.zoom(1.2)
      break
    case 'farther':
      viewer?.zoom(1 / 1.2)
      break
    case 'trails':
      viewer?.toggleTrails()
      break
    case 'bones':
      viewer?.toggleBones()
      break
    case 'signer':
      nextSigner(wardrobe)
      break
    case 'zoomIn':
      timeline?.zoom(1.5)
      break
    case 'zoomOut':
      timeline?.zoom(1 / 1.5)
      break
    case 'fit':
      timeline?.fit()
      break
    case 'full':
      fullscreen()
      break
    case 'help':
      break
    default:
      if ((kViews as readonly string[]).includes(action)) viewer?.look(action)
  }
}

function nextSigner({ all, chosen }: Wardrobe): void {
  preferences.setBody(all[(all.indexOf(chosen ?? kDrawn) + 1) % all.length])
}

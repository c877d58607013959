import type { WebGLRenderer } from 'three'
import type { Api } from '../api/client'
import type { OpenedMotion } from '../motion/source'
import { en, type Text } from '../text/en'
import { CharacterModel } from '../viewer/character_model'
import { Pane } from '../viewer/pane'
import { signerRenderer } from '../viewer/stage'
import { captionOf, drawCaption, type Caption } from './caption'
import { sightsOf, type Sight } from './sight'
import type { RenderRequest } from './request'

/** Draws the frames of one motion, each from its moment alone, on a canvas of exactly the requested size. */
export class Drawing {
  /** Holds the last frame drawn. */
  readonly canvas: OffscreenCanvas
  private readonly context: OffscreenCanvasRenderingContext2D
  private readonly ground: OffscreenCanvas
  private readonly caption?: Caption
  /** Side by side: one, or one for each hand. */
  private readonly sights: readonly Sight[]

  private constructor(
    private readonly renderer: WebGLRenderer,
    private readonly pane: Pane,
    motion: OpenedMotion,
    request: RenderRequest,
    notes: readonly string[],
    text: Text,
  ) {
    const { width, height, view } = request
    this.canvas = new OffscreenCanvas(width, height)
    this.context = this.canvas.getContext('2d', { alpha: false })!
    this.context.fillStyle = '#12161b'
    this.ground = groundOf(width, height)
    this.caption = drawCaption(captionOf(motion.declarations, pane.body.hasFace, notes, text), width, height)
    const foot = this.caption?.height ?? 0,
      lens = pane.camera.camera.fov
    this.sights = sightsOf(motion, pane.signer, view, (shots) => ({ lens, width: width / shots, height, foot }))
    renderer.setScissorTest(true)
  }

  /** Loads the character and positions the camera; all frames must be loaded. `text` is the language of the caption. */
  static async of(api: Api, motion: OpenedMotion, request: RenderRequest, text: Text = en): Promise<Drawing> {
    const renderer = signerRenderer(document.createElement('canvas'))
    renderer.setPixelRatio(1)
    renderer.setSize(request.width, request.height, false)
    const pane = new Pane(motion)
    const notes: string[] = []
    if (motion.character) {
      try {
        pane.wear((await CharacterModel.load(await api.character(motion.character))).body(motion.store.skeleton))
      } catch (fault) {
        console.warn(fault)
        notes.push(text.surfacesMissing.replace('{name}', () => motion.character!))
      }
    }
    try {
      return new Drawing(renderer, pane, motion, request, notes, text)
    } catch (fault) {
      pane.dispose()
      renderer.dispose()
      renderer.forceContextLoss()
      throw fault
    }
  }

  /** Draws a moment, in seconds from the motion's first frame. Throws if the browser has lost the graphics context. */
  draw(seconds: number): void {
    const { renderer, pane, context, canvas, caption } = this
    if (renderer.getContext().isContextLost()) throw new Error('the browser lost the graphics context')
    pane.update(seconds)
    const part = canvas.width / this.sights.length
    this.sights.forEach((sight, k) => {
      renderer.setViewport(k * part, 0, part, canvas.height)
      renderer.setScissor(k * part, 0, part, canvas.height)
      // The second view of a moment reuses the shadows of the first.
      renderer.shadowMap.autoUpdate = k === 0
      renderer.render(pane.scene, sight.at(seconds))
    })
    context.drawImage(this.ground, 0, 0)
    context.drawImage(renderer.domElement, 0, 0)
    for (let k = 1; k < this.sights.length; ++k) context.fillRect(Math.round(k * part) - 1, 0, 2, canvas.height)
    if (caption) context.drawImage(caption.picture, 0, canvas.height - caption.height)
  }

  /** Releases the graphics context: a page has few of them, and may render another video. */
  dispose(): void {
    this.pane.dispose()
    this.renderer.dispose()
    this.renderer.forceContextLoss()
  }
}

/** Draws the plain background behind the signer, lightest behind the head, as in the viewer's dark theme. */
function groundOf(width: number, height: number): OffscreenCanvas {
  const ground = new OffscreenCanvas(width, height)
  const context = ground.getContext('2d')!
  const light = context.createRadialGradient(0, 0, 0, 0, 0, 1)
  light.addColorStop(0, '#414c57')
  light.addColorStop(1, '#232a31')
  context.fillStyle = light
  context.translate(0.5 * width, 0.35 * height)
  context.scale(Math.SQRT2 * 0.5 * width, Math.SQRT2 * 0.65 * height)
  context.fillRect(-2, -2, 4, 4)
  return ground
}

import type { WebGLRenderer } from 'three'
import { restPose, type Pose } from '../motion/pose'
import type { OpenedMotion } from '../motion/source'
import { Actor } from './actor'
import { SignerCamera, type View } from './camera'
import { facingOf } from './facing'
import { drawsBySoftware, Pace } from './pace'
import { Proportions } from './proportions'
import type { Detail } from './solids'
import { stanceOf } from './stance'
import { signerRenderer } from './stage'

/** One small player of a sheet: a motion, its rectangle and its current time. */
export class SheetCell {
  /** On the canvas, in CSS pixels from its top left. */
  x = 0
  y = 0
  width = 0
  height = 0
  /** Seconds from frame 0. */
  time = 0
  /** Whether it has been drawn. */
  seen = false
  readonly pose: Pose

  constructor(
    readonly motion: OpenedMotion,
    readonly actor: Actor,
    readonly camera: SignerCamera,
  ) {
    this.pose = restPose(motion.store.skeleton)
  }
}

/** The maximum number of unused actors kept for reuse. */
const kSpare = 3

/**
 * Draws many signers on one canvas, each into its own rectangle. All motions of a recording share one signer, which takes their poses in turn, so that a
 * hundred cells use no more graphics memory than one. Without shadows, which would take half of the time.
 */
export class Sheet {
  readonly cells = new Map<string, SheetCell>()
  /** Called before each frame with the seconds since the previous one: sets the cells' times. Returns whether one of them changed. */
  onTick?: (elapsed: number) => boolean
  /** Called when the browser takes the graphics context away, and when it restores it. */
  onLost?: (lost: boolean) => void
  /** Called with a new actor, which may be given another body. */
  onActor?: (actor: Actor, motion: OpenedMotion) => void
  /** The main thread's time for the last 120 frames, in ms. */
  readonly costs = new Float32Array(120)
  pictures = 0
  view: View = 'front'
  private readonly renderer: WebGLRenderer
  private readonly pace: Pace
  private readonly actors = new Map<string, Actor>()
  private request = 0
  private last = 0
  private dirty = true
  private height = 1

  constructor(private readonly canvas: HTMLCanvasElement) {
    // Small triangles cost most with antialiasing; a high-density screen does not need it, and software rendering cannot afford it.
    this.renderer = signerRenderer(canvas, window.devicePixelRatio < 2 && !drawsBySoftware())
    this.pace = new Pace(this.renderer.getContext() as WebGL2RenderingContext)
    this.renderer.shadowMap.enabled = false
    this.renderer.autoClear = false
    this.renderer.setPixelRatio(drawsBySoftware() ? 1 : Math.min(2, window.devicePixelRatio))
    canvas.addEventListener('webglcontextlost', this.lost)
    canvas.addEventListener('webglcontextrestored', this.restored)
    this.request = requestAnimationFrame(this.frame)
  }

  /** Adds a cell for a motion; those with the same `skeleton` share a signer. */
  add(key: string, motion: OpenedMotion, skeleton: string, detail: Detail = 'plain'): SheetCell {
    let actor = this.actors.get(skeleton)
    const signer = actor?.signer ?? new Proportions(motion.store.skeleton, motion.rig, stanceOf(motion))
    const facing = facingOf(motion, signer)
    if (!actor) {
      actor = new Actor(signer, facing, detail)
      this.actors.set(skeleton, actor)
      this.onActor?.(actor, motion)
    }
    ++actor.users
    const camera = new SignerCamera(actor.signer, facing)
    camera.look(this.view)
    const cell = new SheetCell(motion, actor, camera)
    this.remove(key)
    this.cells.set(key, cell)
    this.touch()
    return cell
  }

  remove(key: string): void {
    const cell = this.cells.get(key)
    if (!cell) return
    this.cells.delete(key)
    --cell.actor.users
    const spare = [...this.actors].filter(([, { users }]) => users === 0)
    for (const [skeleton, actor] of spare.slice(0, Math.max(0, spare.length - kSpare))) {
      this.actors.delete(skeleton)
      actor.dispose()
    }
    this.touch()
  }

  look(view: View): void {
    this.view = view
    for (const { camera } of this.cells.values()) camera.look(view)
    this.touch()
  }

  resize(width: number, height: number): void {
    this.height = height
    this.renderer.setSize(width, height, false)
    this.touch()
  }

  /** Requests a redraw for a change that the clock does not know of. */
  touch(): void {
    this.dirty = true
  }

  /** The numbers of geometries and textures on the graphics card. */
  get held(): { geometries: number; textures: number } {
    return this.renderer.info.memory
  }
  get actorCount(): number {
    return this.actors.size
  }

  dispose(): void {
    cancelAnimationFrame(this.request)
    this.canvas.removeEventListener('webglcontextlost', this.lost)
    this.canvas.removeEventListener('webglcontextrestored', this.restored)
    this.cells.clear()
    for (const actor of this.actors.values()) actor.dispose()
    this.actors.clear()
    this.renderer.dispose()
    // A browser allows a page about sixteen contexts, and takes the oldest away beyond that.
    this.renderer.forceContextLoss()
  }

  private readonly lost = (): void => this.onLost?.(true)
  private readonly restored = (): void => {
    this.onLost?.(false)
    this.touch()
  }

  private readonly frame = (now: number): void => {
    this.request = requestAnimationFrame(this.frame)
    if (!this.pace.ready(now)) return
    const start = performance.now()
    const elapsed = Math.min(0.5, Math.max(0, (now - this.last) / 1000))
    this.last = now
    const moved = this.onTick?.(elapsed) ?? false
    if (!moved && !this.dirty) return
    this.dirty = false
    this.draw(elapsed)
    this.pace.drew(now)
    this.costs[this.pictures++ % this.costs.length] = performance.now() - start
  }

  private draw(elapsed: number): void {
    const { renderer, height: canvasHeight } = this
    renderer.setScissorTest(false)
    renderer.clear()
    renderer.setScissorTest(true)
    for (const cell of this.cells.values()) {
      const { x, y, width, height, actor, camera, pose } = cell
      if (width <= 0 || y >= canvasHeight || y + height <= 0) continue
      cell.motion.store.sample(cell.time, pose)
      actor.show(pose)
      camera.update(actor.model, width / height, elapsed)
      if (!camera.settled) this.dirty = true
      const bottom = canvasHeight - y - height
      renderer.setViewport(x, bottom, width, height)
      renderer.setScissor(x, bottom, width, height)
      renderer.render(actor.scene, camera.camera)
      cell.seen = true
    }
  }
}

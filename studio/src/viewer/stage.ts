import { ACESFilmicToneMapping, PCFShadowMap, WebGLRenderer } from 'three'
import { StudioFault } from '../api/fault'
import type { View } from './camera'
import { drawsBySoftware, Pace } from './pace'
import type { Pane } from './pane'
import type { Transport } from './transport'

/** The main thread's time per frame, in ms, over about the last second. */
export interface FrameCost {
  mean: number
  most: number
  pictures: number
}

/** Creates the renderer used for all of the studio's pictures of signers. Throws if the browser does not support it. */
export function signerRenderer(canvas: HTMLCanvasElement, antialias = true): WebGLRenderer {
  let renderer: WebGLRenderer
  try {
    renderer = new WebGLRenderer({ canvas, antialias, alpha: true, powerPreference: 'high-performance' })
  } catch {
    throw new StudioFault('noWebgl')
  }
  renderer.toneMapping = ACESFilmicToneMapping
  renderer.toneMappingExposure = 1.05
  renderer.shadowMap.enabled = true
  renderer.shadowMap.type = PCFShadowMap
  renderer.setClearColor(0x000000, 0)
  return renderer
}

/** Draws one or two synchronized motions on one canvas, only while something changes. */
export class Stage {
  readonly panes: Pane[] = []
  /** Called after each frame with its time in seconds; must be quick and allocate nothing. */
  onPicture?: (seconds: number) => void
  /** Called when the browser takes the graphics context away, and when it restores it. */
  onLost?: (lost: boolean) => void
  /** The main thread's time for the last 120 frames, in ms. */
  readonly costs = new Float32Array(120)
  pictures = 0
  private readonly renderer: WebGLRenderer
  /** For software rendering, which takes three times as long with both antialiasing and shadows. */
  private readonly pace?: Pace
  private readonly observer: ResizeObserver
  private request = 0
  /** Of the previous frame, ms of the page's clock. */
  private last = 0
  private dirty = true
  private width = 1
  private height = 1

  constructor(
    private readonly canvas: HTMLCanvasElement,
    readonly transport: Transport,
  ) {
    const software = drawsBySoftware()
    this.renderer = signerRenderer(canvas, !software)
    this.renderer.setPixelRatio(software ? 1 : Math.min(2, window.devicePixelRatio))
    if (software) {
      this.renderer.shadowMap.enabled = false
      this.pace = new Pace(this.renderer.getContext() as WebGL2RenderingContext)
    }
    this.observer = new ResizeObserver(() => this.resize())
    this.observer.observe(canvas.parentElement!)
    canvas.addEventListener('webglcontextlost', this.lost)
    canvas.addEventListener('webglcontextrestored', this.restored)
    this.resize()
    this.request = requestAnimationFrame(this.frame)
  }

  /** Requests a redraw for a change that the transport does not know of. */
  touch(): void {
    this.dirty = true
  }

  look(view: View): void {
    for (const pane of this.panes) pane.camera.look(view)
    this.touch()
  }
  orbit(azimuth: number, elevation: number): void {
    for (const pane of this.panes) pane.camera.orbit(azimuth, elevation)
    this.touch()
  }
  zoom(factor: number): void {
    for (const pane of this.panes) pane.camera.zoom = Math.min(8, Math.max(0.4, pane.camera.zoom * factor))
    this.touch()
  }

  /** Side by side if the canvas is wide, otherwise one above the other. */
  get stacked(): boolean {
    return this.width <= this.height
  }

  /** Whether the last picture is complete: all frames loaded, cameras at rest. */
  get still(): boolean {
    return !this.dirty && !this.transport.playing && !this.panes.some(({ waiting }) => waiting)
  }

  /** The mean and maximum of the last frames. */
  cost(): FrameCost {
    const count = Math.min(this.pictures, this.costs.length)
    let sum = 0,
      most = 0
    for (let i = 0; i < count; ++i) {
      sum += this.costs[i]
      most = Math.max(most, this.costs[i])
    }
    return { mean: count ? sum / count : 0, most, pictures: this.pictures }
  }

  /** The numbers of geometries and textures on the graphics card. */
  get held(): { geometries: number; textures: number } {
    return this.renderer.info.memory
  }

  dispose(): void {
    cancelAnimationFrame(this.request)
    this.observer.disconnect()
    this.canvas.removeEventListener('webglcontextlost', this.lost)
    this.canvas.removeEventListener('webglcontextrestored', this.restored)
    for (const pane of this.panes) pane.dispose()
    this.panes.length = 0
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
    const start = performance.now()
    if (this.transport.tick(now)) this.dirty = true
    if (!this.dirty || this.pace?.ready(now) === false) return
    this.dirty = false
    const { time } = this.transport
    this.draw(time, Math.min(0.25, Math.max(0, (now - this.last) / 1000)))
    this.onPicture?.(time) // afterwards: drawing determines whether time is held, and then no other frame may follow
    this.last = now
    this.pace?.drew(now)
    this.costs[this.pictures++ % this.costs.length] = performance.now() - start
  }

  private draw(seconds: number, elapsed: number): void {
    const { renderer, panes, width, height } = this
    const count = panes.length
    if (count === 0) {
      renderer.setScissorTest(false)
      return renderer.clear()
    }
    let waiting = false
    const stacked = this.stacked
    const w = stacked ? width : width / count,
      h = stacked ? height / count : height
    renderer.setScissorTest(true)
    for (let i = 0; i < count; ++i) {
      const pane = panes[i]
      pane.update(seconds)
      waiting ||= pane.waiting
      const x = stacked ? 0 : i * w,
        y = stacked ? (count - 1 - i) * h : 0
      const shots = pane.cameras.length,
        part = w / shots
      for (let k = 0; k < shots; ++k) {
        const camera = pane.cameras[k]
        pane.aim(camera, part / h, elapsed)
        if (!camera.settled) this.dirty = true
        renderer.setViewport(x + k * part, y, part, h)
        renderer.setScissor(x + k * part, y, part, h)
        // The second view of a signer reuses the shadows of the first.
        renderer.shadowMap.autoUpdate = k === 0
        renderer.render(pane.scene, camera.camera)
      }
      pane.seen ||= pane.body.object.visible
    }
    this.transport.held = waiting
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!
    this.width = Math.max(1, clientWidth)
    this.height = Math.max(1, clientHeight)
    this.renderer.setSize(this.width, this.height, false)
    this.dirty = true
  }
}

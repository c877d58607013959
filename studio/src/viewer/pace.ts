/** The rest granted to the graphics card before the next frame, as a fraction of the last frame's drawing time. */
const kRest = 0.5
/** Ms up to which it needs no rest. */
const kQuick = 40

/**
 * Requests no frame before the last one is drawn. A fast card is not slowed down; if drawing is slow, as with software rendering, the rest of the page still
 * gets its turn.
 */
export class Pace {
  private fence: WebGLSync | null = null
  private asked = 0
  private until = 0

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** Whether a frame may be drawn at `now`, ms of the page's clock. */
  ready(now: number): boolean {
    const { gl, fence } = this
    if (fence) {
      if (!gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) return false
      gl.deleteSync(fence)
      this.fence = null
      const took = now - this.asked
      this.until = took > kQuick ? now + kRest * took : 0
    }
    return now >= this.until
  }

  /** Called after a frame was submitted. */
  drew(now: number): void {
    const { gl } = this
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0)
    gl.flush()
    this.asked = now
  }
}

let software: boolean | undefined

/** Whether this browser renders in software, which is about a hundred times slower than a graphics card. Determined once. */
export function drawsBySoftware(): boolean {
  if (software !== undefined) return software
  const gl = document.createElement('canvas').getContext('webgl2', { failIfMajorPerformanceCaveat: true })
  const names = gl?.getExtension('WEBGL_debug_renderer_info')
  software = gl === null || (names !== undefined && names !== null && isSoftware(String(gl?.getParameter(names.UNMASKED_RENDERER_WEBGL))))
  gl?.getExtension('WEBGL_lose_context')?.loseContext()
  return software
}

/** Recognizes software renderers by their names. */
export function isSoftware(renderer: string): boolean {
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer)
}

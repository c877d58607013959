import { DirectionalLight, HemisphereLight, type Scene, Vector3 } from 'three'
import type { Facing } from './facing'

/** Lighting as in sign language video: the key light from above and slightly to the side, a weak fill, a rim light that separates the arms from the body. */
export class Lights {
  private readonly key = new DirectionalLight(0xfff2e4, 2.1)
  private readonly fill = new DirectionalLight(0xdfeaff, 0.7)
  private readonly rim = new DirectionalLight(0xffffff, 1.5)
  private readonly sky = new HemisphereLight(0xe8f0ff, 0x6b6058, 1.25)
  private readonly from: Vector3

  constructor(
    scene: Scene,
    private readonly signer: Facing,
  ) {
    const { up, left, front, scale } = signer
    const { key, fill, rim, sky } = this
    this.from = new Vector3().addScaledVector(left, 0.9).addScaledVector(up, 1.5).addScaledVector(front, 1.9)
    sky.position.copy(up)
    fill.position.set(0, 0, 0).addScaledVector(left, -2).addScaledVector(up, 0.6).addScaledVector(front, 1.6)
    rim.position.set(0, 0, 0).addScaledVector(left, -1.2).addScaledVector(up, 1.4).addScaledVector(front, -2)
    key.castShadow = true
    key.shadow.mapSize.set(1024, 1024)
    key.shadow.bias = -0.0006
    key.shadow.normalBias = 0.012
    key.shadow.radius = 3
    const reach = 0.95 * scale
    Object.assign(key.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 6 })
    scene.add(sky, fill, rim, key, key.target)
  }

  /** Follows the signer; `root` is the position of the pelvis in model space, metres. */
  follow(root: Vector3): void {
    const { key, signer } = this
    key.target.position.copy(root).addScaledVector(signer.up, 0.35 * signer.scale)
    key.position.copy(key.target.position).add(this.from)
  }

  /**
   * Sets the light for a body: realistic surfaces (skin, cloth) get a softer sky and finer shadows. Ambient light is only a sky: an environment map of a room,
   * blurred for every roughness, took twenty seconds with software rendering.
   */
  suit(real: boolean): void {
    // Dark cloth reflects little: more sky and rim, so that arms stand out against the body.
    this.sky.intensity = real ? 2.1 : 1.25
    this.fill.intensity = real ? 1.1 : 0.7
    this.rim.intensity = real ? 1.6 : 1.5
    const { shadow } = this.key
    shadow.normalBias = real ? 0.004 : 0.012
    shadow.bias = real ? -0.0004 : -0.0006
    const size = real ? 2048 : 1024
    if (shadow.mapSize.x === size) return
    shadow.mapSize.set(size, size)
    shadow.map?.dispose()
    shadow.map = null
  }

  dispose(): void {
    this.key.dispose()
  }
}

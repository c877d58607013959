import { BufferTarget, EncodedPacket, EncodedVideoPacketSource, Output, WebMOutputFormat } from 'mediabunny'
import { microsecondsOf } from './moments'
import { vp9Codec } from './vp9'

/** Seconds between key frames. */
const kKeySeconds = 2
/** The maximum number of frames queued in the encoder. */
const kWaiting = 3
/** Bits per pixel: keeps fingers sharp; at 1280×720 and 30 frames a second at most about 3.3 Mbit/s. */
const kBits = 0.12

/** A WebM video encoded frame by frame, each at the time given by its number, without dropping any. */
export class Film {
  private readonly encoder: VideoEncoder
  private readonly packets: EncodedVideoPacketSource
  private readonly target = new BufferTarget()
  private readonly output = new Output({ format: new WebMOutputFormat(), target: this.target })
  private written: Promise<void>
  private come = 0
  private given = 0
  private fail!: (fault: unknown) => void
  private readonly failed = new Promise<never>((_, reject) => (this.fail = reject))

  private constructor(
    private readonly config: VideoEncoderConfig,
    private readonly rate: number,
  ) {
    this.failed.catch(() => {}) // reported by whatever waits next
    this.packets = new EncodedVideoPacketSource(config.codec.startsWith('vp09') ? 'vp9' : 'vp8')
    this.output.addVideoTrack(this.packets, { frameRate: rate })
    this.written = this.output.start()
    this.encoder = new VideoEncoder({
      output: (chunk, about) => {
        ++this.come
        this.written = this.written.then(() => this.packets.add(EncodedPacket.fromEncodedChunk(chunk), about))
        this.written.catch(this.fail)
      },
      error: (fault) => this.fail(new Error(`the video could not be encoded: ${fault.message}`)),
    })
    this.encoder.configure(config)
  }

  /** Starts a video of this size at `rate` frames a second and `bits` per pixel, in VP9, or in VP8 if the browser has no VP9. */
  static async of(width: number, height: number, rate: number, bits = kBits): Promise<Film> {
    if (typeof VideoEncoder === 'undefined') throw new Error('this browser cannot encode video: it lacks WebCodecs')
    for (const codec of [vp9Codec(width, height, rate), 'vp8']) {
      const config: VideoEncoderConfig = { codec, width, height, framerate: rate, bitrate: Math.round(bits * width * height * rate), latencyMode: 'quality' }
      const { supported } = await VideoEncoder.isConfigSupported(config).catch(() => ({ supported: false }))
      if (supported) return new Film(config, rate)
    }
    throw new Error(`this browser encodes neither VP9 nor VP8 at ${width}×${height}`)
  }

  get codec(): string {
    return this.config.codec
  }

  /** Adds the canvas content as the next frame; resolves when the encoder can take another. */
  async add(canvas: OffscreenCanvas): Promise<void> {
    const picture = this.given++
    const timestamp = microsecondsOf(picture, this.rate)
    const frame = new VideoFrame(canvas, { timestamp, duration: microsecondsOf(picture + 1, this.rate) - timestamp })
    try {
      this.encoder.encode(frame, { keyFrame: picture % Math.max(1, Math.round(kKeySeconds * this.rate)) === 0 })
    } finally {
      frame.close()
    }
    while (this.encoder.encodeQueueSize >= kWaiting) {
      await Promise.race([this.failed, new Promise((resolve) => this.encoder.addEventListener('dequeue', resolve, { once: true }))])
    }
  }

  /** Returns the file's bytes; throws if the encoder dropped a frame. */
  async end(): Promise<ArrayBuffer> {
    await Promise.race([this.failed, this.encoder.flush()])
    this.encoder.close()
    await Promise.race([this.failed, this.written])
    if (this.come !== this.given) throw new Error(`the encoder returned ${this.come} of ${this.given} frames`)
    await this.output.finalize()
    return this.target.buffer!
  }

  /** Releases the encoder if the video is no longer wanted. */
  giveUp(): void {
    if (this.encoder.state !== 'closed') this.encoder.close()
  }
}

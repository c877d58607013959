import { faultOf } from '../api/client'
import { StudioFault } from '../api/fault'
import type { PieceAnswer, PieceRequest } from './piece_worker'

export type Piece = Extract<PieceAnswer, { buffer: ArrayBuffer }>

/** Fetches pieces of motion, unpacked beside the main thread. */
export class Pieces {
  private readonly worker = new Worker(new URL('./piece_worker.ts', import.meta.url), { type: 'module' })
  private readonly waiting = new Map<number, { resolve: (piece: Piece) => void; reject: (fault: Error) => void }>()
  private next = 0

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<PieceAnswer>) => {
      const one = this.waiting.get(data.id)
      this.waiting.delete(data.id)
      if ('refused' in data) one?.reject(refusal(data.refused, data.status))
      else one?.resolve(data)
    }
    this.worker.onerror = (event) => {
      for (const one of this.waiting.values()) one.reject(new StudioFault('fetcherStopped', event.message))
      this.waiting.clear()
    }
  }

  fetch(url: string, first: number, init?: PieceRequest['init']): Promise<Piece> {
    const id = this.next++
    const absolute = new URL(url, document.baseURI).href
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject })
      this.worker.postMessage({ id, url: absolute, init, first } satisfies PieceRequest)
    })
  }

  close(): void {
    this.worker.terminate()
    this.waiting.clear()
  }
}

function refusal(body: string, status: number): Error {
  if (status === 0) return new StudioFault('unreachable')
  return status < 0 ? new StudioFault('badAnswer', body) : faultOf(body, status)
}

import { describe, expect, it } from 'vitest'
import { Transport } from './transport'

function ready(): Transport {
  const transport = new Transport()
  transport.duration = 10
  transport.tick(0)
  return transport
}

describe('the transport', () => {
  it('plays at its speed and stops at the end', () => {
    const transport = ready()
    transport.setSpeed(0.5)
    transport.play()
    expect(transport.tick(200)).toBe(true)
    expect(transport.time).toBeCloseTo(0.1)
    transport.seek(9.99)
    transport.tick(400)
    expect([transport.time, transport.playing]).toEqual([10, false])
  })

  it('steps by whole frames from the nearest', () => {
    const transport = ready()
    transport.rate = 60
    transport.seek(1.004)
    transport.step(1)
    expect(transport.time).toBeCloseTo(61 / 60)
    transport.step(-61)
    transport.step(-5)
    expect(transport.time).toBe(0)
  })

  it('repeats a selection, unless it is shorter than a frame', () => {
    const transport = ready()
    transport.setLoop(3, 2)
    expect(transport.loop).toEqual({ begin: 2, end: 3 })
    transport.play()
    expect(transport.time).toBe(2)
    transport.seek(2.95)
    transport.tick(100)
    expect(transport.time).toBeCloseTo(2.05)
    transport.setLoop(4, 4.001)
    expect(transport.loop).toBeNull()
  })

  it('limits its speed to 0.1 to 2', () => {
    const transport = ready()
    transport.setSpeed(0)
    expect(transport.speed).toBe(0.1)
    transport.setSpeed(7)
    expect(transport.speed).toBe(2)
  })

  it('waits at the end of growing motion, and for missing frames', () => {
    const transport = ready()
    transport.growing = true
    transport.seek(9.95)
    transport.play()
    transport.tick(200)
    expect([transport.time, transport.playing]).toEqual([10, true])
    expect(transport.tick(220)).toBe(false)
    transport.duration = 12
    transport.tick(320)
    expect(transport.time).toBeCloseTo(10.1)
    transport.held = true
    expect([transport.tick(420), transport.time]).toEqual([false, expect.closeTo(10.1)])
    transport.held = false
    transport.tick(520)
    expect(transport.time).toBeCloseTo(10.2)
  })

  it('stays slightly behind a live stream, and catches up', () => {
    const transport = ready()
    transport.live = true
    transport.play()
    transport.tick(20)
    expect(transport.time).toBeCloseTo(9.88)
    for (let now = 40; now < 1000; now += 20) transport.tick(now)
    expect(transport.time).toBeLessThanOrEqual(10)
    expect(transport.time).toBeGreaterThan(9.8)
  })
})

import { inspect } from 'node:util'

/** What went wrong, as a person reads it; node's own frames are of no use. */
function faultOf({ cause, message }) {
  const fault = cause ?? message
  const text = fault instanceof Error ? (fault.stack ?? fault.message) : inspect(fault)
  return text.replace(/^ +at .*\(?node:.*\n?/gm, '').trimEnd()
}

/** A reporter of node:test that sends each test to the process that started this one, and writes nothing. */
export default async function* report(events) {
  for await (const { type, data } of events) {
    if (type !== 'test:pass' && type !== 'test:fail') continue
    const { name, details } = data
    process.send({ name, seconds: details.duration_ms / 1000, fault: type === 'test:fail' ? faultOf(details.error) : undefined })
  }
  yield ''
}

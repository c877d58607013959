import { inspect } from 'node:util'

/** Returns a readable message of a failure; node's own stack frames are omitted. */
function faultOf({ cause, message }) {
  const fault = cause ?? message
  const text = fault instanceof Error ? (fault.stack ?? fault.message) : inspect(fault)
  return text.replace(/^ +at .*\(?node:.*\n?/gm, '').trimEnd()
}

/** A reporter of node:test that sends each test to the parent process, and writes nothing. */
export default async function* report(events) {
  for await (const { type, data } of events) {
    if (type !== 'test:pass' && type !== 'test:fail') continue
    const { name, details } = data
    process.send({ name, seconds: details.duration_ms / 1000, fault: type === 'test:fail' ? faultOf(details.error) : undefined })
  }
  yield ''
}

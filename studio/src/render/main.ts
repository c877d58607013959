import { Delivery } from './delivery'
import { checked, putOf, requestIn } from './request'

/** Renders the request in the address. Any fault, also in code loaded only now, is sent to the server. */
async function run(): Promise<void> {
  const request = requestIn(location.hash)
  const put = putOf(request)
  if (put === undefined) throw new Error('the render request does not contain the address for the result')
  const delivery = new Delivery(put)
  addEventListener('error', ({ error, message }) => delivery.fault(error ?? message))
  addEventListener('unhandledrejection', ({ reason }) => delivery.fault(reason))
  try {
    const { render } = await import('./render')
    await render(checked(request), delivery)
  } catch (fault) {
    delivery.fault(fault)
  }
}

void run()

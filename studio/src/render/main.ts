import { Delivery } from './delivery'
import { checked, putOf, requestIn } from './request'

/** Renders what the address asks for. Whatever goes wrong, also in what is loaded only now, is put as a fault. */
async function run(): Promise<void> {
  const request = requestIn(location.hash)
  const put = putOf(request)
  if (put === undefined) throw new Error('the render request does not say where to put the result')
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

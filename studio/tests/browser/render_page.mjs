import { createServer, request as forward } from 'node:http'

async function bodyOf(request) {
  const parts = []
  for await (const part of request) parts.push(part)
  return Buffer.concat(parts)
}

/**
 * Runs `work(renderer)` with a stand-in for `signweave render`: a server that accepts what the page sends, and forwards everything else to a real one at
 * `real`, which serves the built site and the calls. `renderer.run(page, request)` resolves with what was sent; paths that `renderer.lost` matches are not
 * found.
 */
export async function withRenderer(real, work) {
  const runs = new Map()
  let count = 0
  const renderer = { run, lost: undefined }
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost')
    const [, id, name] = /^\/api\/renders\/([^/]+)\/([^/]+)$/.exec(pathname) ?? []
    if (id) {
      const body = await bodyOf(request)
      const status = runs.get(id)?.(request.method, name, body) ?? 404
      return response
        .writeHead(status, { 'content-type': 'application/json' })
        .end(status === 200 ? '{}' : '{"error":{"code":"io","message":"the disk is full"}}')
    }
    if (renderer.lost?.test(pathname)) return response.writeHead(404).end()
    const { origin, ...headers } = request.headers // the real server is called as by its own pages
    const to = forward(real + request.url, { method: request.method, headers: { ...headers, host: new URL(real).host } }, (answer) => {
      response.writeHead(answer.statusCode, answer.headers)
      answer.pipe(response)
    })
    to.on('error', () => response.destroy())
    request.pipe(to)
  })
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready))
  const address = `http://127.0.0.1:${server.address().port}`

  /** `refuse(name)` selects uploads that are answered as by a server that cannot store them. */
  async function run(page, request, { refuse = () => false, timeout = 600_000, raw } = {}) {
    const id = `r${++count}`
    const put = { files: new Map(), names: [], progress: [], done: undefined, fault: undefined, late: [] }
    const start = performance.now()
    const ended = new Promise((resolve) => {
      runs.set(id, (method, name, body) => {
        if (method !== 'PUT' || body.length === 0) return 400
        if (put.done || put.fault) put.late.push(name)
        if (refuse(name)) return 500
        put.names.push(name)
        if (name === 'progress') put.progress.push({ ms: performance.now() - start, ...JSON.parse(body) })
        else if (name === 'done') resolve((put.done = JSON.parse(body)))
        else if (name === 'fault') resolve((put.fault = body.toString()))
        else put.files.set(name, body)
        return 200
      })
    })
    const hash = raw ?? encodeURIComponent(JSON.stringify({ ...request, put: `/api/renders/${id}` }))
    await page.goto('about:blank')
    await page.goto(`${address}/render.html#${hash.replace('ID', id)}`)
    let timer
    const late = new Promise(
      (_, reject) => (timer = setTimeout(() => reject(new Error(`nothing ended the render; put so far: ${put.names.slice(-5)}`)), timeout)),
    )
    try {
      await Promise.race([ended, late])
    } finally {
      clearTimeout(timer)
    }
    put.seconds = (performance.now() - start) / 1000
    await new Promise((resolve) => setTimeout(resolve, 300)) // for requests after the end, of which there must be none
    return put
  }
  try {
    return await work(renderer)
  } finally {
    server.closeAllConnections()
    server.close()
  }
}

export const kRequest = {
  database: 'demo',
  call: 'sign',
  parameters: { utterance: 'VANNES MATIN' },
  character: '',
  width: 640,
  height: 360,
  rate: 30,
  view: 'front',
  kind: 'webm',
  at_ms: null,
}

/** The paper's first scenario. */
export const kScenario1 = {
  ...kRequest,
  call: 'edit',
  width: 1280,
  height: 720,
  parameters: { recording: 'meteo', replace: ['BRETAGNE=VANNES', 'DEMAIN=MARSEILLE', 'VENDREDI=RENNES', 'MATIN#2="LE MANS"'] },
}

/// <reference types="vitest/config" />
import { svelte } from '@sveltejs/vite-plugin-svelte'
import { defineConfig } from 'vite'
import units from './tests/units.json' with { type: 'json' }

// `npm run dev` forwards calls and streams to a server on this machine.
const server = process.env.SIGNWEAVE ?? 'http://127.0.0.1:8080'

export default defineConfig({
  base: './',
  plugins: [svelte()],
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1200,
    // The studio, and the page that `signweave render` opens.
    rollupOptions: { input: ['index.html', 'render.html'] },
  },
  server: { host: '127.0.0.1', proxy: { '/api': { target: server, ws: true, changeOrigin: true } } },
  test: { include: units, passWithNoTests: false },
})

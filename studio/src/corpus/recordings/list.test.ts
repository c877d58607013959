import { expect, it } from 'vitest'
import { recordingRow } from '../../api/test_answers'
import { rowsOf, signersOf, type ListOptions } from './list'

const row = (name: string, signer: string, frames?: number) =>
  recordingRow(name, signer, frames === undefined ? {} : { frames, frames_per_second: 100, joints: 1, tracks: [] })
const kRows = [row('day 10', 'Zoé', 300), row('day 2', 'Ada', 300), row('words', 'Ada'), row('Day 1', 'Zoé', 900)]
const names = (options: Partial<ListOptions>) => rowsOf(kRows, { text: '', sort: 'name', descending: false, ...options }).map(({ name }) => name)

it('sorts by name in natural order, and by numbers with missing ones at the end', () => {
  expect(names({})).toEqual(['Day 1', 'day 2', 'day 10', 'words'])
  expect(names({ sort: 'seconds' })).toEqual(['day 2', 'day 10', 'Day 1', 'words'])
  expect(names({ sort: 'seconds', descending: true })).toEqual(['Day 1', 'day 2', 'day 10', 'words'])
})

it('finds by name and signer', () => {
  expect(names({ text: ' DAY 1' })).toEqual(['Day 1', 'day 10'])
  expect(names({ signer: 'Ada' })).toEqual(['day 2', 'words'])
  expect(signersOf(kRows)).toEqual(['Ada', 'Zoé'])
})

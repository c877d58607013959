import { expect, it } from 'vitest'
import { errorOf } from '../api/fault'
import { meantBy } from './live_meant'
import { piecePlace, signPlace, type Place } from './project'

/** Without the ids that distinguish places. */
const plain = (places: readonly Place[]) => places.map((place) => ({ ...place, id: 0 }))

it('suggests glosses, and preserves the pause and the token', () => {
  const refused = errorOf({ message: '', code: 'not_found', missing: [{ gloss: 'VANES', matches: ['VANNES', 'LE MANS'], folds: false }] }, 0)
  expect(plain(meantBy(signPlace('VANES', 2, 'comma'), refused))).toEqual(plain([signPlace('VANNES', 2, 'comma'), signPlace('LE MANS', 2, 'comma')]))
})
it('suggests nothing if nothing is similar', () => {
  const refused = errorOf({ message: 'did you mean NANTES?', code: 'not_found', missing: [{ gloss: 'XQZ', matches: [], folds: false }] }, 0)
  expect(meantBy(signPlace('XQZ'), refused)).toEqual([])
  expect(meantBy(signPlace('XQZ'), errorOf({ message: 'did you mean NANTES?', code: 'conflict' }, 0))).toEqual([])
})
it('reads the recording of a piece', () => {
  const refused = errorOf({ message: "no recording 'metoe'; did you mean meteo?", code: 'not_found' }, 0)
  expect(plain(meantBy(piecePlace('metoe', 1, 5), refused))).toEqual(plain([piecePlace('meteo', 1, 5)]))
})

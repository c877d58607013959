import { expect, it } from 'vitest'
import { nameParts } from './name_parts'

it('keeps the distinctive end of a name, with the file extension', () => {
  expect(nameParts('bulletin-meteo-12')).toEqual({ begin: 'bulletin-', end: 'meteo-12' })
  expect(nameParts('bulletin-meteo-12.bvh')).toEqual({ begin: 'bulletin-', end: 'meteo-12.bvh' })
  expect(nameParts('bulletin-meteo-12.face.csv')).toEqual({ begin: 'bulletin-', end: 'meteo-12.face.csv' })
  expect(nameParts('bulletin-meteo-12', 6)).toEqual({ begin: 'bulletin-me', end: 'teo-12' })
  expect(nameParts('entretien 3.14159')).toEqual({ begin: 'entretien ', end: '3.14159' })
  expect(nameParts('bulletin-meteo-1')).toEqual({ begin: 'bulletin-', end: 'meteo-1' })
})
it('splits no short name, and no letter', () => {
  expect(nameParts('meteo')).toEqual({ begin: 'meteo', end: '' })
  expect(nameParts('ISL Thanks 1')).toEqual({ begin: 'ISL Thanks 1', end: '' })
  const accents = `bulletin-${'e\u0301'.repeat(8)}`
  expect(nameParts(accents)).toEqual({ begin: 'bulletin-', end: 'e\u0301'.repeat(8) })
})

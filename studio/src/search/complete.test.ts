import { expect, it } from 'vitest'
import { complete, type Words } from './complete'

const words: Words = {
  glosses: [
    { gloss: 'LE MANS', tokens: 3 },
    { gloss: 'NANTES', tokens: 2 },
    { gloss: 'VANNES', tokens: 5 },
    { gloss: 'ÉTÉ', tokens: 1 },
  ],
  tiers: ['Gloss', 'Mouthing', 'Phase'],
  recordings: ['meteo', 'villes'],
  signers: ['anna'],
  tracks: ['jawOpen'],
  language: {
    fields: ['gloss', 'phase', 'hand', 'hands', 'recording', 'tier', 'duration', 'begin', 'end', 'unit', 'signer'],
    links: ['parent', 'child', 'ancestor', 'descendant', 'overlaps', 'during', 'starts', 'ends', 'equals'],
    phases: ['preparation', 'stroke', 'retraction', 'hold', 'other'],
    hands: ['both', 'right', 'left'],
    two_handed: ['one', 'symmetric', 'alternating', 'asymmetric'],
    points: ['hand', 'left_hand', 'right_hand', 'head', 'neck'],
    functions: ['speed', 'mean_speed', 'path', 'distance', 'contact', 'begin', 'end', 'from', 'to', 'max', 'any', 'enters', 'track', 'gaze', 'like'],
  },
}
/** `|` is the caret. Returns the options, and the text with the first of them inserted. */
const at = (marked: string, known = words) => {
  const caret = marked.indexOf('|'),
    text = marked.slice(0, caret) + marked.slice(caret + 1)
  const { from, to, options, eager } = complete(text, caret, known)
  const [first] = options
  return { labels: options.map(({ label }) => label), first, eager, chosen: first ? text.slice(0, from) + first.insert + text.slice(to) : text }
}

it('offers what can begin a condition', () => {
  const { labels, eager } = at('|')
  for (const one of ['gloss', 'phase', 'tier', 'unit', 'like', 'speed', 'child', 'overlaps', '!', '(', '@']) expect(labels).toContain(one)
  expect(eager).toBe(false)
  expect(at('gl|').chosen).toBe('gloss = ')
  expect(at('dur|').chosen).toBe('duration > ')
  expect(at('gloss = "A" & ph|').chosen).toBe('gloss = "A" & phase = ')
  expect(at('gloss = "A" &ti|').chosen).toBe('gloss = "A" & tier("')
  expect(at('(rec|').chosen).toBe('(recording = ')
  expect(at('gloss = "A" -> sp|').chosen).toBe('gloss = "A" -> speed(')
  expect(at('child(ph|').chosen).toBe('child(phase = ')
  expect(at('gloss = "A" & |').labels).not.toContain('@')
})

it('offers quoted glosses with their tokens, with or without a typed quote', () => {
  expect(at('gloss = |')).toMatchObject({ first: { label: 'LE MANS', insert: '"LE MANS"', tokens: 3 }, eager: true })
  expect(at('gloss = van|').chosen).toBe('gloss = "VANNES"')
  expect(at('gloss = "van|').chosen).toBe('gloss = "VANNES"')
  expect(at('gloss = "van|"').chosen).toBe('gloss = "VANNES"')
  expect(at('gloss != "ete|').chosen).toBe('gloss != "ÉTÉ"')
  expect(at('gloss =v|').chosen).toBe('gloss = "VANNES"')
  expect(at('gloss =|').chosen).toBe('gloss = "LE MANS"')
  expect(at('gloss = ann|').labels).toEqual(['VANNES'])
  expect(at('gloss =~ |').labels).toEqual(['/…/'])
})

it('offers glosses if only words are typed', () => {
  expect(at('vann|').chosen).toBe('VANNES')
  expect(at('vannes "le m|').chosen).toBe('vannes "LE MANS"')
  expect(at('"le m|').chosen).toBe('"LE MANS"')
  expect(at('vannes nan|').chosen).toBe('vannes NANTES')
  expect(at('gloss vann|').labels).not.toContain('VANNES')
  expect(at('phase = stroke & vann|').labels).not.toContain('VANNES')
  expect(at('vannes |').labels).toEqual([])
})

it('overwrites what was typed, and nothing after it', () => {
  expect(at('gloss = "VA|LENCE" & phase = stroke').chosen).toBe('gloss = "VANNES" & phase = stroke')
  expect(at('gloss = "VA| & phase = stroke').chosen).toBe('gloss = "VANNES" & phase = stroke')
  expect(at('gloss = "VA| & recording = "meteo"').chosen).toBe('gloss = "VANNES" & recording = "meteo"')
  expect(at('ph|as = stroke').first?.label).toBe('phase')
})

it('offers values of the other fields', () => {
  expect(at('phase = |').labels).toEqual(words.language.phases)
  expect(at('phase = str|').chosen).toBe('phase = stroke')
  expect(at('hand = |').labels).toEqual(words.language.hands)
  expect(at('hands = |').labels).toEqual(words.language.two_handed)
  expect(at('hands = sy|').chosen).toBe('hands = symmetric')
  expect(at('recording = |').chosen).toBe('recording = "meteo"')
  expect(at('signer != |').chosen).toBe('signer != "anna"')
  expect(at('duration > |').labels).toEqual(['300ms'])
  expect(at('tier("Gloss") = |').labels).toEqual(['"…"', '$X'])
})

it("offers a tier's labels once they are known, and says which tier is needed", () => {
  const wants = (text: string, known = words) => complete(text, text.length, known).wants
  expect([wants('tier("Mouthing") = '), wants('tier("Mouthing") = "nu'), wants('!tier("Gloss") != ')]).toEqual(['Mouthing', 'Mouthing', 'Gloss'])
  // No labels if a name is no tier's, if an expression is written, or elsewhere.
  expect([
    wants('tier("Mouth") = '),
    wants('tier("Mouthing") =~ '),
    wants('tier("Mouthing"'),
    wants('tier("Mouthing") = "nuage" & gloss = '),
    wants('tier("Mouthing") = $X & tier() = '),
  ]).toEqual(Array(5).fill(undefined))
  const known = {
    ...words,
    labels: new Map([
      [
        'Mouthing',
        [
          { label: 'le "nuage"', annotations: 3 },
          { label: 'pluie', annotations: 1 },
        ],
      ],
    ]),
  }
  expect([wants('tier("Mouthing") = ', known), wants('tier("Gloss") = ', known)]).toEqual([undefined, 'Gloss'])
  expect(at('gloss = "A" overlaps tier("Mouthing") = |', known).labels).toEqual(['le "nuage"', 'pluie', '$X'])
  expect(at('tier("Mouthing") = nua|', known)).toMatchObject({ chosen: 'tier("Mouthing") = "le \\"nuage\\""', first: { tokens: 3 } })
  expect(at('tier("Gloss") = |', known).labels).toEqual(['"…"', '$X'])
})

it('offers names of tiers, recordings, tracks and points in parentheses', () => {
  expect(at('tier(|').chosen).toBe('tier("Gloss")')
  expect(at('tier("Mo|').chosen).toBe('tier("Mouthing")')
  expect(at('tier("Mo|") = "x"').chosen).toBe('tier("Mouthing") = "x"')
  expect(at('like(|').chosen).toBe('like("meteo"@')
  expect(at('like("vi|"@100..200)').chosen).toBe('like("villes"@100..200)')
  expect(at('like("villes"@100..200, right_h|)').chosen).toBe('like("villes"@100..200, right_hand)')
  expect(at('track(jaw|').chosen).toBe('track(jawOpen)')
  expect(at('speed(left_|').chosen).toBe('speed(left_hand)')
  expect(at('distance(he|').chosen).toBe('distance(head, ')
  expect(at('distance(head, ne|').chosen).toBe('distance(head, neck)')
  expect(at('gaze(|').labels).toEqual(['yaw', 'pitch'])
})

it('offers comparisons, components and operators that join conditions', () => {
  expect(at('gloss |').labels).toEqual(['=', '!=', '=~'])
  expect(at('hand |').labels).toEqual(['=', '!='])
  expect(at('hands |').labels).toEqual(['=', '!='])
  expect(at('duration |').labels).toContain('>=')
  expect(at('speed |').labels).toEqual(['('])
  expect(at('end(hand)|').labels).toContain('.height')
  expect(at('end(hand).he|').chosen).toBe('end(hand).height')
  expect(at('end(hand).height |').labels).toContain('=')
  expect(at('end(hand).height > sh|').chosen).toBe('end(hand).height > shoulder')
  expect(at('track(jawOpen)|').labels).toContain('.least')
  expect(at('speed(hand) > |').labels).toEqual(['1 m/s'])
  expect(at('contact(hand) = |').labels).toEqual(['hand', 'head', 'torso'])
  expect(at('gloss = "A" |').labels.slice(0, 3)).toEqual(['&', '|', '->'])
  expect(at('gloss = "A" ov|').chosen).toBe('gloss = "A" overlaps ')
  expect(at('(gloss = "A" |').labels).toContain(')')
  expect(at('(gloss = "A") |').labels).not.toContain(')')
  expect(at('duration > 300ms |').labels).toContain('&')
  expect(at('unit |').labels).toContain('&')
})

it('offers the operators over moments', () => {
  expect(at('max(|').labels).toEqual(expect.arrayContaining(['right_hand', 'speed(…)', 'track(…)']))
  expect(at('max(right_|').chosen).toBe('max(right_hand)')
  expect(at('max(right_hand)|').labels).toEqual(['.height', '.x', '.forward', '.openness'])
  expect(at('any(right_hand).pa|').chosen).toBe('any(right_hand).palm')
  expect(at('any(right_hand).palm |').labels).toEqual(['=', '!='])
  expect(at('max(right_hand).height > |').labels).toContain('shoulder')
  expect(at('max(spe|').chosen).toBe('max(speed(')
  expect(at('max(speed(ha|').chosen).toBe('max(speed(hand)')
  expect(at('max(speed(hand)|').labels).toEqual([')'])
  expect(at('max(speed(hand))|').labels).toEqual(['>', '<', '>=', '<='])
  expect(at('max(speed(hand)) > |').labels).toEqual(['1 m/s'])
  expect(at('track(jawOpen).least > |').labels).toEqual(['0.4'])
  expect(at('speed(hand)|').labels).toContain('.least')
  expect(at('enters(ha|').chosen).toBe('enters(hand, ')
  expect(at('enters(hand, ch|').chosen).toBe('enters(hand, chest)')
  expect(at('enters(hand, chin) |').labels).toContain('&')
  expect(at('enters(hand)|').labels).toEqual(['.height', '.x', '.forward'])
  expect(at('enters(hand).height |').labels).toEqual(['='])
  expect(at('enters(hand).height = |').labels).toEqual(['below_waist', 'waist', 'chest', 'shoulder', 'chin', 'mouth', 'forehead', 'above_head'])
})

it('offers angles of places', () => {
  expect(at('from(right_hand)|').labels).toEqual(['.azimuth', '.elevation', '.distance'])
  expect(at('to(hand).az|').chosen).toBe('to(hand).azimuth')
  expect(at('to(hand).azimuth |').labels).toEqual(['>', '<', '>=', '<='])
  expect(at('to(hand).azimuth > |').labels).toEqual(['-30 deg'])
  expect(at('right_hand moves toward @left & pha|').chosen).toBe('right_hand moves toward @left & phase = ')
})

it('is silent if nothing in its lists is valid', () => {
  for (const marked of ['gloss =~ /van|', 'gloss = "A" ->[..|', 'gloss = "VANNES|"', 'phase = stroke|', '12 |', 'tier("A") = "x|'])
    expect(at(marked).labels, marked).toEqual([])
})

it('offers many options, but not all of a large vocabulary', () => {
  const glosses = Array.from({ length: 5000 }, (_, i) => ({ gloss: `G${i}`, tokens: 1 }))
  expect(complete('gloss = ', 8, { ...words, glosses }).options.length).toBeLessThanOrEqual(60)
  expect(complete('gloss = G4999', 13, { ...words, glosses: [...glosses, { gloss: 'G49990', tokens: 1 }] }).options.map(({ label }) => label)).toEqual([
    'G4999',
    'G49990',
  ])
})

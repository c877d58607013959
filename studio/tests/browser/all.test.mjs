// Every view of the studio in one browser: SITE names the built studio.
import assert from 'node:assert/strict'
import { faults, test } from './suite.mjs'
import './studio.test.mjs'
import './compose.test.mjs'
import './compose_keeps.test.mjs'
import './evaluate.test.mjs'
import './compare.test.mjs'
import './search.test.mjs'
import './search_kept.test.mjs'
import './corpus.test.mjs'
import './import_choices.test.mjs'
import './phases.test.mjs'
import './guide.test.mjs'

test('no view threw anything', () => assert.deepEqual(faults, []))

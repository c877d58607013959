/**
 * The browser suites, NAME for NAME.test.mjs, in two halves of about equal duration. They run in parallel, each in a process with its own server, database and
 * browser.
 */
export const kHalves = [
  ['studio', 'search', 'search_kept', 'evaluate', 'guide', 'verb', 'import_choices', 'import_preview', 'sizes', 'drop', 'home', 'lanes'],
  ['compose', 'compose_keeps', 'compare', 'corpus', 'phases', 'render', 'doors', 'names'],
]

/**
 * The browser suites, NAME for NAME.test.mjs, in two halves that take about as long. They run side by side, each in a process of its own with a server, a
 * database and a browser of its own.
 */
export const kHalves = [
  ['studio', 'search', 'search_kept', 'evaluate', 'guide', 'verb', 'import_choices', 'import_preview', 'sizes', 'drop', 'home'],
  ['compose', 'compose_keeps', 'compare', 'corpus', 'phases', 'render', 'doors', 'names'],
]

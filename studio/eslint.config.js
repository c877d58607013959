import js from '@eslint/js'
import svelte from 'eslint-plugin-svelte'
import globals from 'globals'
import ts from 'typescript-eslint'

/** Rules for typed files that need type information. */
const kTyped = {
  '@typescript-eslint/await-thenable': 'error',
  '@typescript-eslint/no-floating-promises': 'error',
  '@typescript-eslint/no-misused-promises': ['error', { checksVoidReturn: false }],
  '@typescript-eslint/no-unnecessary-type-assertion': 'error',
  '@typescript-eslint/only-throw-error': 'error',
  '@typescript-eslint/switch-exhaustiveness-check': ['error', { considerDefaultExhaustiveForUnions: true }],
}

export default ts.config(
  { ignores: ['dist/', '**/node_modules/'] },
  js.configs.recommended,
  ts.configs.recommended,
  svelte.configs.recommended,
  {
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    rules: {
      'array-callback-return': 'error',
      eqeqeq: 'error',
      'no-constructor-return': 'error',
      'no-self-compare': 'error',
      'no-template-curly-in-string': 'error',
      'no-unmodified-loop-condition': 'error',
      'no-unreachable-loop': 'error',
      'no-var': 'error',
      'prefer-const': 'error',
      '@typescript-eslint/no-unused-expressions': ['error', { allowShortCircuit: true }],
      // Properties removed from a rest pattern, and parameters before the one that is used, may be unused.
      '@typescript-eslint/no-unused-vars': ['error', { args: 'after-used', argsIgnorePattern: '^_', varsIgnorePattern: '^_+$', ignoreRestSiblings: true }],
    },
  },
  { files: ['src/**/*.{ts,svelte}'], languageOptions: { globals: globals.browser, parserOptions: { parser: ts.parser } } },
  // Components are excluded: typed rules take minutes for them, and svelte-check covers most of them.
  {
    files: ['src/**/*.ts'],
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: kTyped,
  },
  {
    files: ['**/*.svelte', '**/*.svelte.ts'],
    rules: {
      // Properties are declared with `let`, because some of them are bindable.
      'prefer-const': 'off',
      'svelte/prefer-const': ['error', { excludedRunes: ['$props', '$derived', '$state'] }],
      // Sets and maps are values here: they are replaced in `$state.raw`, never changed.
      'svelte/prefer-svelte-reactivity': 'off',
      // `{' '}` is a space that no formatter removes.
      'svelte/no-useless-mustaches': 'off',
    },
  },
  // Node programs, some of whose functions run in a page.
  { files: ['tests/**/*.{mjs,ts}', 'avatar/**/*.js', '*.{js,mjs,ts}'], languageOptions: { globals: { ...globals.node, ...globals.browser } } },
)

import { mount } from 'svelte'
import App from './App.svelte'
import { preferences } from './ui/preferences.svelte'
import './ui/theme.css'

// Set before anything is drawn, so that nothing flashes up in other colours.
document.documentElement.dataset.theme = preferences.theme
document.documentElement.lang = preferences.language
mount(App, { target: document.getElementById('app')! })

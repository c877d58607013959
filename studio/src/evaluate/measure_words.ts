import type { Measure } from './measures'
import { typeset } from '../text/typeset'

interface Words {
  readonly title: string
  /** What it means, in a line. */ readonly line: string
}
type Table = Readonly<Record<string, Words>>

const en: Table = {
  'wrist/slerp': {
    title: 'Wrist, over slerp’s',
    line: 'Error of the wrist as a part of what a straight turn at one speed (slerp) errs on the same gaps: below 1 is nearer. Look at this first.',
  },
  wrist: { title: 'Wrist', line: 'How far the made wrist is from the captured one, mean over the made frames.' },
  wrist_shoulder_widths: {
    title: 'Wrist, in shoulder widths',
    line: 'The same distance over the distance between the signer’s shoulders, so that bodies of any size compare.',
  },
  fingertips: { title: 'Fingertips', line: 'How far the made fingertips are from the captured ones as seen from the wrist: the handshape alone.' },
  'fingertips/hermite': {
    title: 'Fingertips, over hermite’s',
    line: 'Error of the fingertips as a part of what the method hermite errs on the same gaps: below 1 is nearer.',
  },
  arm_joints: { title: 'Arm joints', line: 'Mean angle between made and captured rotation of each joint from clavicle to wrist.' },
  finger_joints: { title: 'Finger joints', line: 'Mean angle between made and captured rotation of each joint beyond the wrist.' },
  peak_speed_ratio: {
    title: 'Peak speed, made over captured',
    line: 'Fastest moment of the made movement over the fastest of the captured one: 1 is as fast, below 1 too slow.',
  },
  abs_ln_peak_speed_ratio: { title: 'Peak speed, |ln of the ratio|', line: 'How far the peak speed is off, whichever way: 0 is right, 0.1 about a tenth.' },
  peak_time_error: { title: 'Time of the peak', line: 'How much earlier or later than captured the hand is at its fastest.' },
  path_length_ratio: {
    title: 'Length of the way, made over captured',
    line: 'How long the wrist’s way through the gap is: 1 as captured, below 1 it cuts the corner.',
  },
  abs_ln_path_length_ratio: { title: 'Length of the way, |ln of the ratio|', line: 'How far the length of the way is off, whichever way: 0 is right.' },
  log_jerk_difference: {
    title: 'Smoothness (log jerk), made less captured',
    line: 'Below 0 the made movement is less smooth than the captured one, above 0 smoother than the signer was.',
  },
  abs_log_jerk_difference: { title: 'Smoothness (log jerk), |difference|', line: 'How far smoothness is off, whichever way: 0 is as smooth as captured.' },
  spectral_arc_difference: {
    title: 'Smoothness (spectral arc), made less captured',
    line: 'A second measure of smoothness, by the spectrum of the speed: below 0 is less smooth.',
  },
  abs_spectral_arc_difference: { title: 'Smoothness (spectral arc), |difference|', line: 'The same, whichever way: 0 is as smooth as captured.' },
  seam_velocity_jump_ratio: {
    title: 'Kink at the seams',
    line: 'How suddenly the velocity changes where made and captured frames meet, over what it does there in the capture: 1 is unseen, much more is a kink.',
  },
  seam_acceleration_jump_ratio: { title: 'Jolt at the seams', line: 'The same of the acceleration, which the eye sees less.' },
  onset_lag_error: { title: 'One hand after the other', line: 'By how much the delay between the two hands’ starts is off, where both go.' },
  depth_beyond_captured: { title: 'Into the body', line: 'How much deeper the hand goes into head or trunk than it ever did in the capture: 0 is right.' },
  captured_frames_changed: {
    title: 'Captured frames changed',
    line: 'Frames beside the gap that the method wrote to, though they were captured: of at most eight.',
  },
  microseconds: { title: 'Computing time', line: 'Processor time for a gap, all joints. Of this machine and moment.' },
  duration_error: { title: 'Duration, fitted', line: 'How far the fitted duration is from the captured one.' },
  duration_error_of_mean: { title: 'Duration, by the mean', line: 'How far the mean of the other recordings is from it.' },
}

const fr: Table = {
  'wrist/slerp': {
    title: 'Poignet, rapporté à slerp',
    line:
      'Erreur du poignet rapportée à celle d’une rotation directe à vitesse constante (slerp) sur les mêmes intervalles : sous 1, plus proche. ' +
      'À regarder d’abord.',
  },
  wrist: { title: 'Poignet', line: 'Distance entre le poignet composé et le poignet capté, en moyenne sur les images composées.' },
  wrist_shoulder_widths: {
    title: 'Poignet, en largeurs d’épaules',
    line: 'La même distance rapportée à celle entre les épaules du signeur, pour comparer des corps de toute taille.',
  },
  fingertips: { title: 'Bouts des doigts', line: 'Distance entre les bouts des doigts composés et captés, vus du poignet : la seule forme de la main.' },
  'fingertips/hermite': {
    title: 'Bouts des doigts, rapportés à hermite',
    line: 'Erreur des bouts des doigts rapportée à celle de la méthode hermite sur les mêmes intervalles : sous 1, plus proche.',
  },
  arm_joints: { title: 'Articulations du bras', line: 'Angle moyen entre rotation composée et captée de chaque articulation, de la clavicule au poignet.' },
  finger_joints: { title: 'Articulations des doigts', line: 'Angle moyen entre rotation composée et captée de chaque articulation au-delà du poignet.' },
  peak_speed_ratio: {
    title: 'Vitesse maximale, composée sur captée',
    line: 'Instant le plus rapide du mouvement composé sur celui du mouvement capté : 1, aussi rapide ; sous 1, trop lent.',
  },
  abs_ln_peak_speed_ratio: {
    title: 'Vitesse maximale, |ln du rapport|',
    line: 'Écart de la vitesse maximale, dans un sens ou l’autre : 0 est juste, 0,1 environ un dixième.',
  },
  peak_time_error: { title: 'Instant du maximum', line: 'De combien la main est à son plus rapide plus tôt ou plus tard que dans la capture.' },
  path_length_ratio: {
    title: 'Longueur du trajet, composé sur capté',
    line: 'Longueur du trajet du poignet dans l’intervalle : 1, comme capté ; sous 1, il coupe au plus court.',
  },
  abs_ln_path_length_ratio: { title: 'Longueur du trajet, |ln du rapport|', line: 'Écart de la longueur du trajet, dans un sens ou l’autre : 0 est juste.' },
  log_jerk_difference: {
    title: 'Fluidité (jerk logarithmique), composé moins capté',
    line: 'Sous 0 le mouvement composé est moins fluide que le capté, au-dessus de 0 plus fluide que le signeur.',
  },
  abs_log_jerk_difference: {
    title: 'Fluidité (jerk logarithmique), |écart|',
    line: 'Écart de fluidité, dans un sens ou l’autre : 0, aussi fluide que la capture.',
  },
  spectral_arc_difference: {
    title: 'Fluidité (arc spectral), composé moins capté',
    line: 'Une seconde mesure de fluidité, par le spectre de la vitesse : sous 0, moins fluide.',
  },
  abs_spectral_arc_difference: { title: 'Fluidité (arc spectral), |écart|', line: 'La même, dans un sens ou l’autre : 0, aussi fluide que la capture.' },
  seam_velocity_jump_ratio: {
    title: 'À-coup aux raccords',
    line: 'Changement brusque de vitesse là où images composées et captées se rejoignent, rapporté à la capture : 1 ne se voit pas, bien plus est un à-coup.',
  },
  seam_acceleration_jump_ratio: { title: 'Secousse aux raccords', line: 'La même chose pour l’accélération, que l’œil voit moins.' },
  onset_lag_error: { title: 'Une main après l’autre', line: 'De combien le retard entre les départs des deux mains est faux, quand les deux bougent.' },
  depth_beyond_captured: { title: 'Dans le corps', line: 'De combien la main entre plus profond dans la tête ou le tronc que dans la capture : 0 est juste.' },
  captured_frames_changed: {
    title: 'Images captées changées',
    line: 'Images au bord de l’intervalle que la méthode a réécrites, bien que captées : huit au plus.',
  },
  microseconds: { title: 'Temps de calcul', line: 'Temps de processeur par intervalle, toutes articulations. De cette machine, à ce moment.' },
  duration_error: { title: 'Durée, ajustée', line: 'Écart entre la durée ajustée et la durée captée.' },
  duration_error_of_mean: { title: 'Durée, par la moyenne', line: 'Écart entre la moyenne des autres enregistrements et la durée captée.' },
}
export const measureWords = { en, fr: typeset(fr) }

/** Its name with its unit; the server's own name where the studio knows none. */
export function titleOf({ measure, unit }: Pick<Measure, 'measure' | 'unit'>, language: 'en' | 'fr'): string {
  const title = measureWords[language][measure]?.title ?? measure
  return unit ? `${title}, ${unit}` : title
}

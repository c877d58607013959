import type { Measure } from './measures'
import { typeset } from '../text/typeset'

interface Messages {
  readonly title: string
  /** A one-line description. */ readonly line: string
}
type Table = Readonly<Record<string, Messages>>

const en: Table = {
  'wrist/slerp': {
    title: 'Wrist, relative to slerp',
    line: 'Wrist error relative to that of a direct rotation at constant speed (slerp) on the same gaps: below 1 is closer. Look at this first.',
  },
  wrist: { title: 'Wrist', line: 'Distance between the generated and the captured wrist, mean over the generated frames.' },
  wrist_shoulder_widths: {
    title: 'Wrist, in shoulder widths',
    line: 'The same distance divided by the signer’s shoulder width, so that bodies of any size can be compared.',
  },
  fingertips: { title: 'Fingertips', line: 'Distance between the generated and the captured fingertips relative to the wrist: the handshape alone.' },
  'fingertips/hermite': {
    title: 'Fingertips, relative to hermite',
    line: 'Fingertip error relative to that of the method hermite on the same gaps: below 1 is closer.',
  },
  arm_joints: { title: 'Arm joints', line: 'Mean angle between the generated and the captured rotation of each joint from clavicle to wrist.' },
  finger_joints: { title: 'Finger joints', line: 'Mean angle between the generated and the captured rotation of each joint beyond the wrist.' },
  peak_speed_ratio: {
    title: 'Peak speed, generated over captured',
    line: 'Peak speed of the generated movement divided by that of the captured one: 1 is equally fast, below 1 too slow.',
  },
  abs_ln_peak_speed_ratio: { title: 'Peak speed, |ln of the ratio|', line: 'Error of the peak speed in either direction: 0 is right, 0.1 about a tenth.' },
  peak_time_error: { title: 'Time of the peak', line: 'How much earlier or later than in the capture the hand reaches its peak speed.' },
  path_length_ratio: {
    title: 'Path length, generated over captured',
    line: 'Length of the wrist’s path through the gap: 1 is as captured, below 1 it cuts the corner.',
  },
  abs_ln_path_length_ratio: { title: 'Path length, |ln of the ratio|', line: 'Error of the path length in either direction: 0 is right.' },
  log_jerk_difference: {
    title: 'Smoothness (log jerk), generated minus captured',
    line: 'Below 0 the generated movement is less smooth than the captured one, above 0 it is smoother.',
  },
  abs_log_jerk_difference: { title: 'Smoothness (log jerk), |difference|', line: 'Error of the smoothness in either direction: 0 is as smooth as captured.' },
  spectral_arc_difference: {
    title: 'Smoothness (spectral arc), generated minus captured',
    line: 'A second measure of smoothness, from the spectrum of the speed: below 0 is less smooth.',
  },
  abs_spectral_arc_difference: { title: 'Smoothness (spectral arc), |difference|', line: 'The same in either direction: 0 is as smooth as captured.' },
  seam_velocity_jump_ratio: {
    title: 'Kink at the seams',
    line: 'Velocity jump where generated and captured frames meet, relative to the capture at the same frames: 1 is invisible, much more is a kink.',
  },
  seam_acceleration_jump_ratio: { title: 'Jolt at the seams', line: 'The same for the acceleration, which is less visible.' },
  onset_lag_error: { title: 'Delay between the hands', line: 'Error of the delay between the starts of the two hands, if both move.' },
  depth_beyond_captured: {
    title: 'Penetration of the body',
    line: 'How much deeper the hand enters the head or trunk than it ever does in the capture: 0 is right.',
  },
  captured_frames_changed: {
    title: 'Captured frames changed',
    line: 'Captured frames next to the gap that the method overwrote: at most eight.',
  },
  microseconds: { title: 'Computing time', line: 'Processor time per gap for all joints, on this machine at this time.' },
  duration_error: { title: 'Duration, fitted', line: 'Difference between the fitted and the captured duration.' },
  duration_error_of_mean: { title: 'Duration, by the mean', line: 'Difference between the mean of the other recordings and the captured duration.' },
}

const fr: Table = {
  'wrist/slerp': {
    title: 'Poignet, rapporté à slerp',
    line:
      'Erreur du poignet rapportée à celle d’une rotation directe à vitesse constante (slerp) sur les mêmes intervalles : sous 1, plus proche. ' +
      'À regarder d’abord.',
  },
  wrist: { title: 'Poignet', line: 'Distance entre le poignet généré et le poignet capté, en moyenne sur les images générées.' },
  wrist_shoulder_widths: {
    title: 'Poignet, en largeurs d’épaules',
    line: 'La même distance rapportée à celle entre les épaules du signeur, pour comparer des corps de toute taille.',
  },
  fingertips: {
    title: 'Bouts des doigts',
    line: 'Distance entre les bouts des doigts générés et captés, par rapport au poignet : la configuration de la main seule.',
  },
  'fingertips/hermite': {
    title: 'Bouts des doigts, rapportés à hermite',
    line: 'Erreur des bouts des doigts rapportée à celle de la méthode hermite sur les mêmes intervalles : sous 1, plus proche.',
  },
  arm_joints: { title: 'Articulations du bras', line: 'Angle moyen entre les rotations générée et captée de chaque articulation, de la clavicule au poignet.' },
  finger_joints: { title: 'Articulations des doigts', line: 'Angle moyen entre les rotations générée et captée de chaque articulation au-delà du poignet.' },
  peak_speed_ratio: {
    title: 'Vitesse maximale, générée sur captée',
    line: 'Vitesse maximale du mouvement généré divisée par celle du mouvement capté : 1, aussi rapide ; sous 1, trop lent.',
  },
  abs_ln_peak_speed_ratio: {
    title: 'Vitesse maximale, |ln du rapport|',
    line: 'Écart de la vitesse maximale, dans un sens ou l’autre : 0 est juste, 0,1 environ un dixième.',
  },
  peak_time_error: { title: 'Instant du maximum', line: 'Avance ou retard, par rapport à la capture, de l’instant où la main est la plus rapide.' },
  path_length_ratio: {
    title: 'Longueur du trajet, généré sur capté',
    line: 'Longueur du trajet du poignet dans l’intervalle : 1, comme capté ; sous 1, il coupe au plus court.',
  },
  abs_ln_path_length_ratio: { title: 'Longueur du trajet, |ln du rapport|', line: 'Écart de la longueur du trajet, dans un sens ou l’autre : 0 est juste.' },
  log_jerk_difference: {
    title: 'Fluidité (jerk logarithmique), généré moins capté',
    line: 'Sous 0, le mouvement généré est moins fluide que le mouvement capté ; au-dessus de 0, il est plus fluide.',
  },
  abs_log_jerk_difference: {
    title: 'Fluidité (jerk logarithmique), |écart|',
    line: 'Écart de fluidité, dans un sens ou l’autre : 0, aussi fluide que la capture.',
  },
  spectral_arc_difference: {
    title: 'Fluidité (arc spectral), généré moins capté',
    line: 'Une seconde mesure de fluidité, par le spectre de la vitesse : sous 0, moins fluide.',
  },
  abs_spectral_arc_difference: { title: 'Fluidité (arc spectral), |écart|', line: 'La même, dans un sens ou l’autre : 0, aussi fluide que la capture.' },
  seam_velocity_jump_ratio: {
    title: 'À-coup aux raccords',
    line: 'Saut de vitesse là où les images générées et captées se rejoignent, rapporté à la capture : 1 ne se voit pas, bien plus est un à-coup.',
  },
  seam_acceleration_jump_ratio: { title: 'Secousse aux raccords', line: 'La même chose pour l’accélération, que l’œil voit moins.' },
  onset_lag_error: { title: 'Décalage entre les mains', line: 'Erreur du décalage entre les départs des deux mains, quand les deux bougent.' },
  depth_beyond_captured: {
    title: 'Pénétration dans le corps',
    line: 'Profondeur à laquelle la main entre dans la tête ou le tronc au-delà de la capture : 0 est juste.',
  },
  captured_frames_changed: {
    title: 'Images captées modifiées',
    line: 'Images captées au bord de l’intervalle que la méthode a réécrites : huit au plus.',
  },
  microseconds: { title: 'Temps de calcul', line: 'Temps de processeur par intervalle pour toutes les articulations, sur cette machine, à ce moment.' },
  duration_error: { title: 'Durée, ajustée', line: 'Écart entre la durée ajustée et la durée captée.' },
  duration_error_of_mean: { title: 'Durée, par la moyenne', line: 'Écart entre la moyenne des autres enregistrements et la durée captée.' },
}
export const measureMessages = { en, fr: typeset(fr) }

/** Returns the name with the unit; the server's own name if the studio does not know the measure. */
export function titleOf({ measure, unit }: Pick<Measure, 'measure' | 'unit'>, language: 'en' | 'fr'): string {
  const title = measureMessages[language][measure]?.title ?? measure
  return unit ? `${title}, ${unit}` : title
}

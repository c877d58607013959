// Parts of the language listed in docs/query.md but not in the server's vocabulary.

const kPlaces = ['.azimuth', '.elevation', '.distance']
const kComponents = ['.height', '.x', '.forward', '.openness', '.palm', '.fingers', '.contact']
/** The components of which a quantity requires one. */
export const kComponentsOf: Readonly<Record<string, readonly string[]>> = {
  begin: kComponents,
  end: kComponents,
  from: kPlaces,
  to: kPlaces,
  any: kComponents,
  max: kComponents.slice(0, 4),
  min: kComponents.slice(0, 4),
  enters: kComponents.slice(0, 3),
}
/** The components that a quantity may have. */
export const kMomentsOf: Readonly<Record<string, readonly string[]>> = {
  speed: ['.least'],
  acceleration: ['.least'],
  distance: ['.begin', '.end', '.most'],
  track: ['.least', '.begin', '.end'],
  gaze: ['.least', '.begin', '.end'],
}
/** Quantities that also accept a quantity of kMomentsOf: max(speed(right_hand)). */
export const kOverMoments: readonly string[] = ['max', 'min', 'any']
export const kAngles = ['yaw', 'pitch'] as const
const kDirections = ['up', 'down', 'left', 'right', 'forward', 'back']
/** The names with which a component can be compared. */
export const kNamesOf: Readonly<Record<string, readonly string[]>> = {
  '.height': ['below_waist', 'waist', 'chest', 'shoulder', 'chin', 'mouth', 'forehead', 'above_head'],
  '.x': ['left', 'centre', 'right'],
  '.forward': ['near', 'far'],
  '.palm': kDirections,
  '.fingers': kDirections,
  '.contact': ['hand', 'head', 'torso'],
  contact: ['hand', 'head', 'torso'],
}
/** The zones that enters(POINT, …) accepts. */
export const kZones: readonly string[] = ['.height', '.x', '.forward'].flatMap((part) => kNamesOf[part])
/** An example number for each quantity. */
export const kNumberOf: Readonly<Record<string, string>> = {
  duration: '300ms',
  begin: '1s',
  end: '1s',
  speed: '1 m/s',
  mean_speed: '1 m/s',
  acceleration: '10 m/s2',
  mean_acceleration: '10 m/s2',
  path: '40 cm',
  displacement: '20 cm',
  distance: '30 cm',
  track: '0.4',
  mean_track: '0.2',
  gaze: '15 deg',
  mean_gaze: '5 deg',
  '.height': '20 cm',
  '.x': '20 cm',
  '.forward': '30 cm',
  '.openness': '0.5',
  '.azimuth': '-30 deg',
  '.elevation': '10 deg',
  '.distance': '1.2',
}
/** Fields that contain texts, in the order in which they are offered, and how they begin. */
export const kTextFields: readonly string[] = ['gloss', 'phase', 'hand', 'hands', 'recording', 'signer']
export const kTimes: readonly string[] = ['duration', 'begin', 'end']
export const kRelations: readonly string[] = ['overlaps', 'during', 'starts', 'ends', 'equals']

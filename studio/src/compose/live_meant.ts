import { suggested, type ApiError } from '../api/fault'
import { piecePlace, signPlace, type Place } from './project'

/** Returns suggestions for a place that the server refused, most likely first. */
export function meantBy(place: Place, refused: ApiError): readonly Place[] {
  // Only the message names recordings similar to that of a piece.
  if (place.kind === 'piece') return suggested(refused.message).map((recording) => piecePlace(recording, place.from, place.to, place.pause, place.join))
  return refused.missing.flatMap(({ matches }) => matches).map((gloss) => signPlace(gloss, place.token, place.pause, place.join))
}

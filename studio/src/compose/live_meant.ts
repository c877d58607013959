import { suggested, type ApiError } from '../api/fault'
import { piecePlace, signPlace, type Place } from './project'

/** What was meant by a place that the server would not sign, the likeliest first. */
export function meantBy(place: Place, refused: ApiError): readonly Place[] {
  // The line alone names recordings that are like the one of a piece.
  if (place.kind === 'piece') return suggested(refused.message).map((recording) => piecePlace(recording, place.from, place.to, place.pause, place.join))
  return refused.missing.flatMap(({ matches }) => matches).map((gloss) => signPlace(gloss, place.token, place.pause, place.join))
}

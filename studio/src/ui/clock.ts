/** Formats seconds as m:ss.mmm, or with fewer digits; annotation time may be negative. */
export function clock(seconds: number, digits = 3): string {
  const unit = 10 ** digits
  const parts = Math.round(Math.abs(seconds) * unit)
  const whole = Math.floor(parts / unit)
  const rest = digits > 0 ? `.${String(parts % unit).padStart(digits, '0')}` : ''
  return `${seconds < 0 && parts > 0 ? '−' : ''}${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}${rest}`
}

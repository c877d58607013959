enum class Place : int {

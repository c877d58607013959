# against_release.awk RELEASE LINES: compares benchmark results with those of the last release (bench/release.txt), by name.
# If a name occurs several times in LINES, from several runs, the best result counts. Prints each missed goal with the
# figure of the last release, and fails if a figure is more than three times as bad. Yardsticks are measured in the same
# run, so a slow machine makes no ratio worse. If a yardstick is a fixed number, and so the same as at the release, the
# figure fails only if its goal is missed as well. A figure that was 0 at the release is printed, and cannot fail.
BEGIN { kMost = 3 }
/^#/ || $6 !~ /^[<>]=$/ { next }  # a line without a goal
{
  at_most = $6 == "<="
  figure = NF > 7 ? $2 : $5  # a goal with a unit applies to the value, others to the ratio
  goal = $7
  for (i = 8; i <= NF; ++i) goal = goal " " $i
}
FILENAME == ARGV[1] { released[$1] = figure; yardstick[$1] = $4; next }
{
  is_new = !($1 in best)
  if (is_new) names[++count] = $1
  if (is_new || (at_most ? figure < best[$1] : figure > best[$1])) {
    best[$1] = figure
    aim[$1] = $6 " " goal
    missed[$1] = at_most ? figure > $7 : figure < $7
    if (!($1 in released)) next
    times[$1] = at_most ? (released[$1] > 0 ? figure / released[$1] : 0) : (figure > 0 ? released[$1] / figure : kMost + 1)
    fixed[$1] = $4 == yardstick[$1]
  }
}
END {
  for (i = 1; i <= count; ++i) {
    name = names[i]
    if (!(name in released)) {
      printf "new since the last release: %s %s (goal %s)\n", name, best[name], aim[name]
    } else if (times[name] > kMost && (missed[name] || !fixed[name])) {
      printf "failed: %s: %s, %.1f times as bad as at the last release (%s; goal %s)\n", name, best[name], times[name], released[name], aim[name]
      status = 1
    } else if (missed[name]) {
      printf "goal missed: %s: %s (goal %s; last release %s)\n", name, best[name], aim[name], released[name]
    }
  }
  for (name in released) {
    if (name in best) continue
    printf "failed: %s: the last release had it (%s), and no benchmark prints it now\n", name, released[name]
    status = 1
  }
  exit status
}

# Sourced in studio/: installs the packages where the lock file is newer than what is there, and puts the pinned Node first
# in PATH, since Vite needs a newer one than Debian 12 has. Of several at once one installs, and the others wait for it.
stale='[ ! -e node_modules/.package-lock.json ] || [ package-lock.json -nt node_modules/.package-lock.json ]'
if eval "$stale"; then
  flock .install.lock sh -c "if $stale; then npm ci --silent && touch node_modules/.package-lock.json; fi"
fi
for folder in node_modules/node-linux-*/bin; do
  if [ -x "$folder/node" ]; then PATH=$PWD/$folder:$PATH; fi
done
export PATH

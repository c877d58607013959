# Sourced in studio/: installs the packages where the lock file is newer than what is there, and puts the pinned Node first
# in PATH, since Vite needs a newer one than Debian 12 has. Of several at once one installs, and the others wait for it.
# The pinned Node comes first and installs the rest: npm leaves out, without a word, what the Node that it runs with is too old for.
# It trusts what the machine trusts, as Debian's own does.
stale='[ ! -e node_modules/.package-lock.json ] || [ package-lock.json -nt node_modules/.package-lock.json ]'
install='
  first=$(mktemp -d)
  trap "rm -rf $first" EXIT
  npm ci --silent --no-audit --omit=dev
  cp node_modules/node-linux-*/bin/node "$first/"
  NODE_OPTIONS=--use-system-ca PATH=$first:$PATH npm ci --silent --no-audit
  touch node_modules/.package-lock.json'
if eval "$stale"; then
  flock .install.lock sh -ec "if $stale; then $install
    fi"
fi
for folder in node_modules/node-linux-*/bin; do
  if [ -x "$folder/node" ]; then PATH=$PWD/$folder:$PATH; fi
done
export PATH

# Sourced in studio/: installs the packages if the lock file is newer than the installed ones, and puts the pinned Node
# first in PATH, since Vite needs a newer version than Debian 12 has. If several processes source it at once, one installs
# and the others wait. The pinned Node is installed first and then installs the rest: npm silently omits packages for which
# the Node that it runs on is too old. It trusts the machine's certificates, as Debian's own Node does.
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

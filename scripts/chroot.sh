# A bare Debian 12 in a folder (debootstrap, as root); sourced by scripts/fresh, scripts/package and scripts/aarch64.
# Package sources and their settings are copied from this machine.
#   chroot_make [FOLDER]   creates it in $root: FOLDER, or a folder under /tmp that is removed at the end of the script
#   chroot_run COMMAND     runs a bash command in it

chroot_make() {
  [ "$(id -u)" -eq 0 ] || { echo "$0: needs root, for debootstrap and chroot" >&2; exit 1; }
  command -v debootstrap >/dev/null || { apt-get update -qq; apt-get install -y -qq debootstrap >/dev/null; }
  root=${1:-$(mktemp -d)}
  [ $# -eq 0 ] || chroot_kept=1
  trap chroot_cleanup EXIT
  local mirror folder
  mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | grep -E '^(URIs:|deb )' |
    grep -oE 'https?://[^ ]+' | grep -v security | head -n 1 || true)
  [ -e "$root/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$root" "${mirror:-http://deb.debian.org/debian}" >/dev/null
  # Copies the host's access to its package registry: sources, keys, proxies, certificates, names.
  rm -f "$root/etc/apt/sources.list"
  cp -rT /etc/apt "$root/etc/apt"
  cp /etc/resolv.conf /etc/hosts "$root/etc/" 2>/dev/null || true
  # A folder used before contains links there; seen from here they point into the host, so they are replaced, not
  # written through.
  for folder in /etc/ssl/certs /usr/share/keyrings /usr/local/share/ca-certificates; do
    [ -d "$folder" ] && mkdir -p "$root$folder" && cp -rLT --remove-destination "$folder" "$root$folder"
  done
  chmod 755 "$root"  # mktemp restricts it to root
  mount --bind /proc "$root/proc"
  mount --bind /dev "$root/dev"
  mount --bind /dev/pts "$root/dev/pts"
}

chroot_cleanup() {
  local point
  for point in dev/pts proc dev; do
    if mountpoint -q "$root/$point"; then umount -l "$root/$point"; fi
  done
  [ -n "${chroot_kept:-}" ] || rm -rf --one-file-system "$root"
}

chroot_run() {
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} ${no_proxy:+no_proxy="$no_proxy"} \
    bash -c "$1"
}

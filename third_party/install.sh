#!/usr/bin/env bash
# Installs what third_party/packages.txt lists and this machine lacks; silent and instant when nothing is missing.
# Exit code 3 where packages are missing and there is neither root nor sudo (prints the command instead).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
minimum_mesa=24.1   # lavapipe offers acceleration structures from here on; 24.0's never ends some kernels

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "raylab: no apt on this system; install by hand what $here/packages.txt lists" >&2
  exit 0
fi

installed_list=" $(dpkg-query -W -f='${db:Status-Status} ${Package} ' 2>/dev/null) "
installed() { [[ "$installed_list" == *" installed $1 "* ]]; }
available() { [ -n "$(apt-cache madison "$1" 2>/dev/null)" ]; }
mesa_version() { dpkg-query -W -f='${Version}' mesa-vulkan-drivers 2>/dev/null || echo 0; }
mesa_is_old() { dpkg --compare-versions "$(mesa_version)" lt "$minimum_mesa"; }
newer_mesa_is_offered() {
  local candidate
  candidate=$(apt-cache policy mesa-vulkan-drivers 2>/dev/null | awk '$1 == "Candidate:" { print $2 }')
  case "$candidate" in [0-9]*) dpkg --compare-versions "$candidate" ge "$minimum_mesa" ;; *) false ;; esac
}
is_bookworm() { . /etc/os-release && [ "${VERSION_CODENAME:-}" = bookworm ]; }

# Lines of the list that no installed package satisfies.
missing_lines() {
  sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$here/packages.txt" | while IFS= read -r line; do
    satisfied=no
    for name in ${line//|/ }; do
      if installed "$name"; then satisfied=yes; fi
    done
    [ "$satisfied" = yes ] || echo "$line"
  done
}

# The mirror from which this machine already takes bookworm, as "URI KEYRING" (KEYRING may be empty).
bookworm_mirror() {
  local files=() file
  for file in /etc/apt/sources.list.d/*.sources /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    if [ -f "$file" ]; then files+=("$file"); fi  # awk gives up at a file that is not there
  done
  if [ "${#files[@]}" = 0 ]; then return; fi
  awk '
    function flush() { if (uris != "" && suites ~ /(^| )bookworm( |$)/) { split(uris, u, " "); print u[1], key; found = 1; exit } uris = ""; suites = ""; key = "" }
    FILENAME ~ /\.sources$/ {
      if ($0 ~ /^[[:space:]]*$/) flush()
      else if ($1 == "URIs:") { sub(/^URIs:[[:space:]]*/, ""); uris = $0 }
      else if ($1 == "Suites:") { sub(/^Suites:[[:space:]]*/, ""); suites = $0 }
      else if ($1 == "Signed-By:") key = $2
      next
    }
    $1 == "deb" {
      key = ""; i = 2
      if ($2 ~ /^\[/) { while (i <= NF) { if (match($i, /signed-by=[^] ]+/)) key = substr($i, RSTART + 10, RLENGTH - 10); if ($i ~ /\]$/) break; i++ } i++ }
      if ($(i + 1) == "bookworm") { print $i, key; found = 1; exit }
    }
    END { if (!found) flush() }
  ' "${files[@]}" | head -n 1
}

lines=$(missing_lines)
need_backport=no
need_upgrade=no
if mesa_is_old; then
  if is_bookworm; then need_backport=yes; elif newer_mesa_is_offered; then need_upgrade=yes; fi
fi
if [ -z "$lines" ] && [ "$need_backport" = no ] && [ "$need_upgrade" = no ]; then exit 0; fi

as_root=()
if [ "$(id -u)" != 0 ]; then
  if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
    as_root=(sudo)
  else
    echo "raylab: packages are missing, and installing them needs root. Run this, then try again:" >&2
    echo "  su -c '$here/install.sh'" >&2
    exit 3
  fi
fi

if [ "$need_backport" = yes ] && ! grep -rqs 'bookworm-backports' /etc/apt/sources.list /etc/apt/sources.list.d; then
  read -r uri key < <(bookworm_mirror) || true
  if [ -z "${uri:-}" ]; then
    echo "raylab: no apt source names bookworm, so bookworm-backports (mesa-vulkan-drivers $minimum_mesa or newer) cannot be added" >&2
    exit 3
  fi
  {
    echo "Types: deb"
    echo "URIs: $uri"
    echo "Suites: bookworm-backports"
    echo "Components: main"
    if [ -n "${key:-}" ]; then echo "Signed-By: $key"; fi
  } | "${as_root[@]}" tee /etc/apt/sources.list.d/raylab-backports.sources >/dev/null
fi

echo "raylab: installing packages (once)" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
names=()
while IFS= read -r line; do
  [ -n "$line" ] || continue
  chosen=
  for name in ${line//|/ }; do
    if available "$name"; then chosen=$name; break; fi
  done
  if [ -z "$chosen" ]; then
    echo "raylab: no apt source of this machine offers: $line" >&2
    exit 3
  fi
  names+=("$chosen")
done <<<"$lines"
if [ "$need_upgrade" = yes ] && newer_mesa_is_offered; then names+=(mesa-vulkan-drivers); fi
apt_install() { "${as_root[@]}" apt-get install -y -qq --no-install-recommends "$@" >&2; }
if [ "$need_backport" = yes ]; then apt_install -t bookworm-backports mesa-vulkan-drivers; fi
if [ "${#names[@]}" -gt 0 ]; then apt_install "${names[@]}"; fi
if mesa_is_old; then
  echo "raylab: Mesa $(mesa_version) is older than $minimum_mesa: on lavapipe hardware traversal is missing and some kernels never end;" \
    "take mesa-vulkan-drivers from this system's updates (such as noble-updates)" >&2
fi

#!/bin/sh
# Installs the packages of tools/packages.txt that are missing: tools/install.sh run|test|peers|bench
# Says nothing when there is nothing to do. Other distributions: installs nothing, and leaves the verdict to CMake.
list="$(dirname "$0")/packages.txt"
case "$1" in
    test) groups="run test" ;;
    *) groups="$1" ;;
esac
command -v dpkg-query >/dev/null || exit 0

namesOf() {
    awk -v groups="$1" '!/^#/ {split($2, own, ","); for (i in own) if (index(" " groups " ", " " own[i] " ")) print $1}' "$list"
}

# One dpkg-query for all packages: one for each would cost a quarter of a second in every run.
# shellcheck disable=SC2046  # names are words
installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $(namesOf "$groups") 2>/dev/null |
            awk '$1 == "installed" {print $2}')
missing=$(namesOf "$groups" | grep -vxF "$installed" | tr '\n' ' ')
[ -z "$missing" ] && exit 0

if [ "$(id -u)" = 0 ]; then
    asRoot=""
elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
    asRoot="sudo"
else
    echo "packages are missing, and only root can install them: sudo apt-get install $missing" >&2
    exit 1
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Never a question: there may be nobody to answer.
apt() {
    $asRoot env DEBIAN_FRONTEND=noninteractive apt-get -y -qq --no-install-recommends "$@" </dev/null >"$log" 2>&1
}
echo "installing $missing" >&2
apt update || echo "apt-get update failed; trying with the package lists that are here" >&2
if [ "$1" = peers ] || [ "$1" = bench ]; then  # one without the other will do, and the caller says which is left out
    for package in $missing; do
        apt install "$package" || true
    done
    exit 0
fi
# shellcheck disable=SC2086  # names are words
if ! apt install $missing; then
    tail -n 5 "$log" >&2
    echo "apt-get could not install $missing(its last lines are above): is the network up, and this Debian 12?" >&2
    exit 1
fi
for package in $(namesOf optional); do
    apt install "$package" || echo "$package is not to be had here: going on without it" >&2
done

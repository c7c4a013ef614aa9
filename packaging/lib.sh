# Shared by packaging/run and packaging/test: packages, configuring, building. Sourced, not run.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

say() { printf '== %s\n' "$*"; }
die() {
    printf 'error: %s\n' "$*" >&2
    exit 1
}

# Lists of packages that install_packages installs.
package_lists=("$root/packaging/dependencies")

# Names in package_lists that are not installed.
missing_packages() {
    local name
    sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "${package_lists[@]}" | while read -r name; do
        # Node is often there from elsewhere, and Debian's npm brings hundreds of packages.
        case "$name" in
        nodejs) command -v node >/dev/null && continue ;;
        npm) command -v npm >/dev/null && continue ;;
        esac
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || printf '%s\n' "$name"
    done
}

# Installs what is missing, without questions; does nothing, and needs no rights, when all is there.
install_packages() {
    command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
        die "this script installs Debian packages, and here is no apt-get. Install the equivalents of packaging/dependencies by hand, then: cmake --preset release && cmake --build --preset release"
    local missing
    mapfile -t missing < <(missing_packages)
    if [ "${#missing[@]}" -eq 0 ]; then
        say "Packages: all of ${package_lists[*]#"$root/"} are installed"
        return
    fi
    say "Packages: installing ${missing[*]}"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "installing needs root, and here is no sudo. As root: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update ||
        die "apt-get update failed: is the package archive reachable?"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" ||
        die "apt-get could not install: ${missing[*]}"
}

# Compilers at once: one per core, but no more than memory allows at 1.5 GiB each.
build_jobs() {
    local cores memory
    cores="$(nproc)"
    memory="$(awk '/^MemAvailable:/ { print int($2 / 1572864) }' /proc/meminfo)"
    [ "${memory:-0}" -ge 1 ] || memory=1
    echo "$((cores < memory ? cores : memory))"
}

# build [TARGET...]: preset release, all targets without arguments.
build() {
    local targets=()
    [ $# -eq 0 ] || targets=(--target "$@")
    say "Configuring build/release"
    (cd "$root" && cmake --preset release) || die "CMake could not configure the project; the lines above say why"
    say "Building ${*:-everything} with $(build_jobs) jobs"
    (cd "$root" && cmake --build --preset release -j "$(build_jobs)" "${targets[@]}") ||
        die "the build failed; the first error above says where"
}

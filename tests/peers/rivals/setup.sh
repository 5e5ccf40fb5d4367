#!/bin/bash
# Installs and unpacks what the peers need (Debian 12, root, ordinary apt). Run once; safe to repeat.
set -e
. "$(dirname "$0")/env.sh"
export DEBIAN_FRONTEND=noninteractive
apt-get install -y --no-install-recommends libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri mesa-vulkan-drivers \
    libvulkan1 glslang-tools

# The newest Mesa: packages of Debian unstable, unpacked beside, never installed.
A=$PEERS_DIR/apt-sid
mkdir -p "$A"/{lists/partial,cache/archives/partial} "$NEW"; : > "$A/status"
SITE=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Codename: bookworm' | head -1)
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $SITE sid main" > "$A/sources.list"
APT="apt-get -o Dir::State::lists=$A/lists -o Dir::State::status=$A/status -o Dir::Cache=$A/cache
 -o Dir::Etc::sourcelist=$A/sources.list -o Dir::Etc::sourceparts=- -o APT::Sandbox::User=root
 -o APT::Install-Recommends=false"
$APT update
$APT install -y --download-only libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri mesa-vulkan-drivers libvulkan1 libc6 libstdc++6
for d in "$A"/cache/archives/*.deb; do dpkg-deb -x "$d" "$NEW"; done
sed "s#\"library_path\": *\"[^\"]*\"#\"library_path\": \"$NEW/$LIBS/libvulkan_lvp.so\"#" \
    "$NEW"/usr/share/vulkan/icd.d/lvp_icd*.json > "$PEERS_DIR/lvp-new.json"

# SwiftShader: inside Debian's chromium-common.
(cd "$PEERS_DIR" && apt-get download chromium-common && dpkg-deb -x chromium-common_*.deb swiftshader && rm chromium-common_*.deb)
SO=$PEERS_DIR/swiftshader/usr/lib/chromium
sed "s#\./libvk_swiftshader.so#$SO/libvk_swiftshader.so#" "$SO/vk_swiftshader_icd.json" > "$PEERS_DIR/swiftshader.json"
build

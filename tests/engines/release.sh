#!/usr/bin/env bash
# Tries what the last jobs of a release run, for .ci/workflows, with stand-ins for gh and docker that write down what they are told:
#
#   tests/engines/release.sh ARCHIVE FOLDER
set -euo pipefail
archive=$(realpath "$1")
mkdir "$2"
folder=$(realpath "$2")
cd "$(dirname "$0")/../.."

fail() { echo "release: $1" >&2; exit 1; }
# A repository whose version is dated.
mkdir "$folder/root" "$folder/bin"
cp -r .ci .github Cargo.toml "$folder/root"
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -1)
sed "s/^## $version, unreleased$/## $version, 2026-01-01/" CHANGELOG.md > "$folder/root/CHANGELOG.md"
cp README.md "$folder/root"
code=0
"$folder/root/.ci/release-notes" "$version" > /dev/null 2>&1 || code=$?
[ "$code" = 1 ] || ! grep -q "not released yet" README.md || fail "what the README marks as not released is released"
sed -i "s/, which is not released yet,//" "$folder/root/README.md"

notes=$("$folder/root/.ci/release-notes" "$version")
links=$(grep -oE '\]\([^)]*\)' <<< "$notes" | grep -v '^](https://' || true)
[ -z "$links" ] || fail "links of the notes lead nowhere: $links"
code=0
.ci/release-notes 99.0.0 > /dev/null 2>&1 || code=$?
[ "$code" = 1 ] || fail "another version has notes"

# The files of every target, all with the bytes of one archive.
mkdir "$folder/files"
while read -r target; do
    case $target in *windows*) packing=zip ;; *) packing=tar.gz ;; esac
    file=coupler-atlas-$version-$target.$packing
    cp "$archive" "$folder/files/$file"
    (cd "$folder/files" && sha256sum -- "$file" > "$file.sha256")
    touch "$folder/files/coupler_atlas-$version-cp310-abi3-$target.whl"
done < <(grep -oE 'target: [a-z0-9_-]+' .github/workflows/release.yml | sed 's/target: //' | sort -u)
touch "$folder/files/coupler_atlas-$version.tar.gz"
.ci/checksums "$folder/files" > /dev/null
(cd "$folder/files" && sha256sum --check --quiet SHA256SUMS && [ "$(wc -l < SHA256SUMS)" = "$(find . -name '*.gz' -o -name '*.zip' -o -name '*.whl' | wc -l)" ])
rm "$folder/files"/*apple-darwin.whl
! .ci/checksums "$folder/files" 2> /dev/null || fail "missing wheels are not missed"

# IS_DRAFT is what there is of the release; gh says it on the error output if there is none.
cat > "$folder/bin/gh" << 'GH'
#!/bin/sh
[ "$2" != view ] || { [ -n "$IS_DRAFT" ] && echo "$IS_DRAFT" && exit; echo "$PROBLEM" >&2; exit 1; }
echo "$@" >> "$CALLS"
GH
cat > "$folder/bin/docker" << 'DOCKER'
#!/bin/sh
echo "$@" >> "$CALLS"
DOCKER
chmod +x "$folder/bin"/*
export CALLS=$folder/calls IS_DRAFT='' PROBLEM="release not found" PATH=$folder/bin:$PATH
draft() {
    : > "$CALLS"
    (cd "$folder" && root/.ci/draft "$version" files 2> /dev/null)
}
draft
grep -q "^release create v$version --draft --verify-tag" "$CALLS" && grep -q "^release upload v$version --clobber .*SHA256SUMS" "$CALLS" || fail "no draft"
! grep -q -e --prerelease "$CALLS" || fail "$version is no pre-release"
IS_DRAFT=true draft
grep -q "^release edit" "$CALLS" && ! grep -q "^release create" "$CALLS" || fail "a second draft"
! IS_DRAFT=false draft && [ ! -s "$CALLS" ] || fail "what has been published is changed"
! PROBLEM="no connection" draft && [ ! -s "$CALLS" ] || fail "a draft though it is not known whether there is one"
sed -i "0,/^version = /s/^version = .*/version = \"9.0.0-rc.1\"/" "$folder/root/Cargo.toml"
sed -i "s/^## $version, /## 9.0.0-rc.1, /" "$folder/root/CHANGELOG.md"
version=9.0.0-rc.1 draft
grep -q "^release create v9.0.0-rc.1 .*--prerelease" "$CALLS" || fail "9.0.0-rc.1 is a pre-release"

tags() {
    : > "$CALLS"
    .ci/image push registry/name "$1" "$folder"
    sed -n 's/^buildx imagetools create //p' "$CALLS" | tr ' ' '\n' | sed -n 's/^--tag=registry.name://p' | tr '\n' ' '
}
[ "$(tags 1.2.3)" = "v1.2.3 1.2 latest " ] && [ "$(tags 1.2.3-rc.1)" = "v1.2.3-rc.1 " ] || fail "the tags of an image"
[ "$(grep -c ^push "$CALLS")" = 2 ] || fail "the images of two architectures are not pushed"
echo "workflows: the files of a release are complete, drafted once, and the image has its tags"

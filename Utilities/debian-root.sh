# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Makes a fresh Debian system in a folder and runs commands in it. Source this file after common.sh; do not run it.
# Needs root and the Debian archive.
# shellcheck shell=bash
#
#   root               folder of the system; set by the script
#   DEBIAN_MIRROR=URL  another mirror of Debian, or a line of apt's sources.list:
#                      DEBIAN_MIRROR="deb [check-valid-until=no] http://deb.debian.org/debian testing main"
#                      accepts a mirror that is weeks old
: "${root:=}"

need_root()
{
  if [ "$(id -u)" -ne 0 ]; then
    echo "Creating a Debian system for the tests requires root: sudo $0" >&2
    exit 1
  fi
}

# make_debian RELEASE : RELEASE is Debian's name for it, such as bookworm.
make_debian()
{
  remove_debian
  mmdebstrap --variant=minbase --dpkgopt=force-unsafe-io "$1" "$root" ${DEBIAN_MIRROR:+"$DEBIAN_MIRROR"}
  echo "127.0.0.1 localhost" >"$root/etc/hosts" # minbase does not have this file
}

remove_debian()
{
  rm -rf --one-file-system "$root"
}

# in_debian COMMAND... : runs it as root in the system. The mounts end together with the command.
#   shared  if set, a folder of this machine that the command sees under the same path, read-only
#   alone   if set, the command has no network. Commands that open windows need this, or else programs in the
#           system talk to X servers of the machine: the names of their sockets belong to the network.
in_debian()
{
  # shellcheck disable=SC2016 # the inner shell expands these
  unshare --mount ${alone:+--net} sh -ec '
    root=$1 shared=$2 alone=$3; shift 3
    mount --bind "$root" "$root" # a mount point: unshare in the system, for a system in it, needs one
    mount -t proc proc "$root/proc"
    mount -t sysfs -o ro sysfs "$root/sys"
    mkdir -p "$root/dev/shm"
    mount -t tmpfs tmpfs "$root/dev/shm"
    mkdir -p "$root/dev/pts"
    mount -t devpts -o mode=620,ptmxmode=666 devpts "$root/dev/pts"
    mount --bind "$root/dev/pts/ptmx" "$root/dev/ptmx"
    if [ -n "$shared" ]; then
      mkdir -p "$root$shared"
      mount --bind "$shared" "$root$shared"
      mount -o remount,bind,ro "$root$shared"
    fi
    [ -z "$alone" ] || ip link set lo up
    exec chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
      HOME=/root DEBIAN_FRONTEND=noninteractive LIBGL_ALWAYS_SOFTWARE=1 "$@"
  ' sh "$root" "${shared:-}" "${alone:-}" "$@"
}

# as_user FOLDER COMMAND... : runs it in the folder, as a user without rights and settings.
as_user()
{
  local folder=$1
  shift
  in_debian setpriv --reuid=65534 --regid=65534 --clear-groups env -C "$folder" "HOME=$folder" "$@"
}

#!/usr/bin/env bash
# The Falcon's and the SpaceMouse's driver against the kernel's own USB and HID stacks: boots Debian's kernel in QEMU with
# a virtual USB host controller and user-space HID, and devices in software behind them. About two minutes; needs neither
# root (but for missing packages) nor KVM. Exits 1 when a check fails, 69 when a package cannot be had.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_missing "$project/tools/packages.txt" "$project/tools/packages-vm.txt"
work="$project/build/vm"
mkdir -p "$work/kernel"

# The kernel is unpacked, never installed. Its cloud variant has no USB.
if ! ls "$work"/kernel/boot/vmlinuz-* >/dev/null 2>&1; then
  kernel="$(apt-cache depends linux-image-amd64 | sed -n 's/.*Depends: \(linux-image-.*-amd64\)$/\1/p' | head -1)"
  if [ -z "$kernel" ] || ! (cd "$work" && apt-get download "$kernel" >&2); then
    echo "the kernel's package linux-image-amd64 could not be downloaded: run apt-get update, and see to the network" >&2
    exit 69
  fi
  dpkg -x "$work"/linux-image-*.deb "$work/kernel"
  rm "$work"/linux-image-*.deb
fi
modules="$(echo "$work"/kernel/lib/modules/*)/kernel/drivers"

build release -- vm_check
check="$(find "$project/build/release/tests/device/vm" -name vm_check -type f)"

# One archive: busybox, the modules in the order in which they need each other, the program and its libraries.
root="$work/root"
rm -rf "$root"
mkdir -p "$root"/{bin,dev,lib,lib64,modules,proc,sys,tmp}
cp "$(command -v busybox)" "$root/bin/busybox"
cp "$check" "$root/bin/vm_check"
ldd "$check" | grep -o '/[^ ]*' | while read -r library; do
  mkdir -p "$root/$(dirname "$library")"
  cp -L "$library" "$root/$library"
done
list=(usb/common/usb-common usb/core/usbcore usb/usbip/usbip-core usb/usbip/vhci-hcd hid/hid hid/uhid hid/hid-generic)
for module in "${list[@]}"; do cp "$modules/$module.ko" "$root/modules/"; done
{
  echo '#!/bin/busybox sh'
  echo '/bin/busybox mount -t proc proc /proc'
  echo '/bin/busybox mount -t sysfs sysfs /sys'
  echo '/bin/busybox mount -t devtmpfs devtmpfs /dev'
  for module in "${list[@]}"; do
    echo "/bin/busybox insmod /modules/$(basename "$module").ko || echo 'no module $(basename "$module")'"
  done
  echo '/bin/vm_check; echo "vm_check ended with $?"'
  echo '/bin/busybox poweroff -f'
} >"$root/init"
chmod +x "$root/init"
(cd "$root" && find . | cpio -o -H newc --quiet | gzip -1) >"$work/initramfs.gz"

output="$work/output.txt"
timeout 600 qemu-system-x86_64 -accel tcg,thread=multi -smp 2 -m 512 -nographic -no-reboot -nodefaults -serial stdio \
  -kernel "$work"/kernel/boot/vmlinuz-* -initrd "$work/initramfs.gz" \
  -append "console=ttyS0 panic=-1 quiet loglevel=1" </dev/null | tee "$output" || true
if ! grep -q '^vm_check ended with 0' "$output"; then
  echo "a check failed, or the virtual machine did not come so far; all it said is in $output" >&2
  exit 1
fi

#!/bin/sh
# make_man_page.sh PROGRAM VERSION DATE: the manual page of a program, from what its --help says, on standard output.
set -eu
program="$1" version="$2" date="$3"
name="$(basename "$program")"
upper="$(printf '%s' "$name" | tr '[:lower:]' '[:upper:]')"
folder="$(cd "$(dirname "$0")" && pwd)"

page_part() { # page_part LEVEL [SUBCOMMAND]
  "$program" ${2:+"$2"} --help | awk -v level="$1" -v name="$name" -v subcommand="${2:-}" -f "$folder/help_to_man.awk"
}

printf '.TH %s 1 "%s" "Myotact %s"\n' "$(printf '%s' "$upper" | sed 's/-/\\-/g')" "$date" "$version"
page_part page
subcommands="$("$program" --help | awk '/^Subcommands:/ {on = 1; next} on && /^  [a-z]/ {print $1}')"
for subcommand in $subcommands; do page_part subcommand "$subcommand"; done
cat <<'END'
.SH EXIT STATUS
0 done, 1 a check failed, 2 usage, 65 bad data, 66 no such input, 69 device or display not there, 70 internal fault,
74 input or output, 130 and 143 after SIGINT and SIGTERM.
.SH ENVIRONMENT
.TP
.B MYOTACT_DATA_DIR
The folder that holds shaders, assets and meshes; without it, share/myotact beside the program's bin.
END
if [ "$name" = myotact ]; then
  printf '.SH NOTES\nNot a medical device: nothing here is certified for diagnosis, therapy or safety.\n'
  printf '.SH SEE ALSO\n.BR myotact\\-prepare (1)\n'
else
  printf '.SH SEE ALSO\n.BR myotact (1)\n'
fi

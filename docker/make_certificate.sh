#!/usr/bin/env bash
# A certificate that signs itself, to try the container with: clients must be configured to trust it.
# usage: docker/make_certificate.sh FOLDER NAME    writes FOLDER/tls.crt and FOLDER/tls.key
set -euo pipefail
folder="${1:?usage: make_certificate.sh FOLDER NAME}"
name="${2:?usage: make_certificate.sh FOLDER NAME}"
mkdir -p "$folder"
umask 077
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 30 -subj "/CN=$name" \
  -addext "subjectAltName=DNS:$name,IP:127.0.0.1" -keyout "$folder/tls.key" -out "$folder/tls.crt" 2>/dev/null
echo "$folder/tls.crt and $folder/tls.key for $name, good for 30 days"

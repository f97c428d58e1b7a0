# Debian 12 with everything that make run, make test and make lessons need: for macOS (whose OpenGL stops at 4.1) and Windows.
#   docker build -t voxel-light-workbook . && docker run --rm -it -v "$PWD":/workbook voxel-light-workbook
FROM debian:12
RUN apt-get update -q && apt-get install -y -q --no-install-recommends ca-certificates git make sudo
# The one list of packages; when only the code changes, this layer stays.
COPY tests/tools/packages.txt tests/tools/deps.sh /setup/
RUN sh /setup/deps.sh run test book && rm -rf /var/lib/apt/lists/*
RUN useradd --create-home --shell /bin/bash reader && echo 'reader ALL=(root) NOPASSWD: ALL' >/etc/sudoers.d/reader
USER reader
WORKDIR /workbook
CMD ["bash"]

# Talus in a container: docs/install.md. It is built as on any Debian 12, and run by a user who is not root.
FROM debian:12 AS build
WORKDIR /src
COPY . .
RUN ./bootstrap build \
 && cmake --install build/release --prefix /usr/local --strip

FROM debian:12
# What the program is linked with, what draws maps, movies and figures, and what the Python package reads and draws with.
RUN apt-get update \
 && apt-get install -y --no-install-recommends \
      libcairo2 libfmt9 libfreetype6 libgcc-s1 libglfw3 libhdf5-103-1 libpng16-16 libstdc++6 libtomlplusplus3 libxxhash0 zlib1g \
      libosmesa6 ffmpeg \
      python3-h5py python3-numpy python3-xxhash python3-matplotlib \
 && rm -rf /var/lib/apt/lists/*
COPY --from=build /usr/local /usr/local
RUN useradd --create-home talus \
 && install -d -o talus -g talus /runs
USER talus
WORKDIR /runs
ENTRYPOINT ["talus"]
CMD ["--help"]

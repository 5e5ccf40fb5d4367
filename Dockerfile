# The viewer without its window, as a static program in an empty image. Written, not run.
#   docker build -t trigon-viewer .
#   docker run --rm -v "$PWD:/data" trigon-viewer model.glb --output model.png
FROM rust:1.95-alpine AS build
RUN apk add --no-cache musl-dev
WORKDIR /trigon
COPY . .
RUN cargo build --release --locked -p trigon-viewer --no-default-features

FROM scratch
COPY --from=build /trigon/target/release/trigon-viewer /trigon-viewer
# Where `batch --verify` draws again.
WORKDIR /tmp
WORKDIR /data
ENTRYPOINT ["/trigon-viewer"]

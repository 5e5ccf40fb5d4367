# Common settings; sourced by the other scripts.
# PEERS_DIR: where downloads and build outputs go: target/peers unless it is set.
HERE=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export PEERS_DIR=${PEERS_DIR:-$HERE/../../../target/peers}
mkdir -p "$PEERS_DIR" && PEERS_DIR=$(cd "$PEERS_DIR" && pwd)
BIN=$PEERS_DIR/target/release                 # generic x86-64 (the work is done in the driver)
NATIVE=$PEERS_DIR/target-native/release       # -C target-cpu=native (the Rust crates)
NEW=$PEERS_DIR/root-sid                       # unpacked packages of Debian unstable: newest Mesa
LIBS=usr/lib/x86_64-linux-gnu

build() {
    (cd "$HERE" && CARGO_TARGET_DIR=$PEERS_DIR/target cargo build --release -q \
        -p peer-gl -p peer-vk &&
     RUSTFLAGS="-C target-cpu=native" CARGO_TARGET_DIR=$PEERS_DIR/target-native \
        cargo build --release -q -p peer-euc -p peer-retrofire)
}

# Runs a program against the libraries (libc included) of $NEW.
with_new() {
    env __EGL_VENDOR_LIBRARY_DIRS="$NEW/usr/share/glvnd/egl_vendor.d" LIBGL_DRIVERS_PATH="$NEW/$LIBS/dri" \
        VK_DRIVER_FILES="$PEERS_DIR/lvp-new.json" VK_ICD_FILENAMES="$PEERS_DIR/lvp-new.json" \
        "$NEW/$LIBS/ld-linux-x86-64.so.2" --library-path "$NEW/$LIBS" "$@"
}

# one PEER THREADS [workload...]: one process, one line of CSV for each workload.
# THREADS: 1 = everything pinned to one core; 1+1, 2+1 = llvmpipe's rasterizer threads beside the
# application's thread (LP_NUM_THREADS = 1, 2), not pinned; 2 = all cores.
one() {
    local peer=$1 threads=$2 pin="" lp=0; shift 2
    case $threads in 1) pin="taskset -c 0";; 1+1) lp=1;; 2+1) lp=2;; esac
    export PEERS_NAME=$peer PEERS_THREADS=$threads PEERS_SUPERSAMPLES=1
    # llvmpipe-new-4x4: 4×4 samples for each pixel, all of them shaded.
    case $peer in *-2x2|*-4x4) PEERS_SUPERSAMPLES=${peer: -1}; peer=${peer%-?x?};; esac
    case $peer in
        llvmpipe-debian) LP_NUM_THREADS=$lp $pin "$BIN/peer-gl" "$@";;
        llvmpipe-new)    export LP_NUM_THREADS=$lp; [ -n "$pin" ] && pin_self; with_new "$BIN/peer-gl" "$@"; unpin_self;;
        # the same, but malloc keeps freed memory, so that a frame does not fault its bins in anew
        llvmpipe-keep)   export LP_NUM_THREADS=$lp MALLOC_ARENA_MAX=1 MALLOC_TOP_PAD_=268435456 \
                             MALLOC_MMAP_THRESHOLD_=4000000000 MALLOC_TRIM_THRESHOLD_=16000000000
                         [ -n "$pin" ] && pin_self; with_new "$BIN/peer-gl" "$@"; unpin_self;;
        lavapipe-new)    export LP_NUM_THREADS=$lp; [ -n "$pin" ] && pin_self; with_new "$BIN/peer-vk" "$@"; unpin_self;;
        swiftshader)     VK_DRIVER_FILES=$PEERS_DIR/swiftshader.json VK_ICD_FILENAMES=$PEERS_DIR/swiftshader.json \
                             $pin "$BIN/peer-vk" "$@";;
        euc)             $pin "$NATIVE/peer-euc" "$@";;
        retrofire)       $pin "$NATIVE/peer-retrofire" "$@";;
        *) echo "no peer $peer" >&2; return 1;;
    esac
}
# A shell function cannot be an argument of taskset, so the shell itself is pinned for its child.
pin_self() { taskset -pc 0 $BASHPID >/dev/null; }
unpin_self() { taskset -pc "0-$(($(nproc --all) - 1))" $BASHPID >/dev/null; }

CONFIGS="llvmpipe-debian:1 llvmpipe-debian:1+1 llvmpipe-debian:2+1
llvmpipe-new:1 llvmpipe-new:1+1 llvmpipe-new:2+1
llvmpipe-keep:1 llvmpipe-keep:1+1 llvmpipe-keep:2+1
lavapipe-new:1 lavapipe-new:1+1 lavapipe-new:2+1
swiftshader:1 swiftshader:2 euc:1 retrofire:1"

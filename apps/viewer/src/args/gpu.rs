//! F3D flags for graphics cards, ray tracers or plugins.

/// Scripts that use these flags keep running; a warning says that they have no effect.
#[derive(Debug, clap::Args)]
pub(crate) struct GpuOnly {
    #[arg(long, hide = true)]
    rendering_backend: Option<String>,
    #[arg(long, short = 'r', hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    raytracing: Option<String>,
    #[arg(long, hide = true)]
    raytracing_samples: Option<String>,
    #[arg(long, short = 'd', hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    raytracing_denoise: Option<String>,
    #[arg(long, short = 'v', hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    volume: Option<String>,
    #[arg(long, short = 'i', hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    volume_inverse: Option<String>,
    #[arg(long, hide = true)]
    volume_opacity_file: Option<String>,
    #[arg(long, hide = true)]
    volume_opacity_map: Option<String>,
    #[arg(long, hide = true)]
    load_plugins: Option<String>,
    #[arg(long, hide = true)]
    plugins_path: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    scan_plugins: Option<String>,
}

const NO_GPU: &str = "trigon draws on the CPU, so this option does not apply";
const NO_RAY_TRACER: &str =
    "write --shadows=rays and --bounces=N for rays, --samples for the number of samples";
const NO_VOLUME: &str = "there are no volumes in the formats that are read (-v is --volume; for more output use --verbose, for the version --version)";
const NO_PLUGINS: &str = "there are no plugins; --list-readers lists all formats";

impl GpuOnly {
    /// A warning for each flag given.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let flags = [
            ("--rendering-backend", &self.rendering_backend, NO_GPU),
            ("--raytracing", &self.raytracing, NO_RAY_TRACER),
            ("--raytracing-samples", &self.raytracing_samples, NO_RAY_TRACER),
            ("--raytracing-denoise", &self.raytracing_denoise, NO_RAY_TRACER),
            ("--volume", &self.volume, NO_VOLUME),
            ("--volume-inverse", &self.volume_inverse, NO_VOLUME),
            ("--volume-opacity-file", &self.volume_opacity_file, NO_VOLUME),
            ("--volume-opacity-map", &self.volume_opacity_map, NO_VOLUME),
            ("--load-plugins", &self.load_plugins, NO_PLUGINS),
            ("--plugins-path", &self.plugins_path, NO_PLUGINS),
            ("--scan-plugins", &self.scan_plugins, NO_PLUGINS),
        ];
        let given = flags.into_iter().filter(|(_, value, _)| value.is_some());
        given.map(|(flag, _, why)| format!("{flag} is ignored: {why}")).collect()
    }
}

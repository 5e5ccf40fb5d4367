//! Cameras.

use pyo3::prelude::*;
use trigon_camera::{
    Camera, CameraAxes, CameraError, FisheyeCamera, FisheyeLens, Intrinsics, PixelCenters, Projection,
    Projector, Viewport,
};
use trigon_math::{Bounds3, DAffine3, DVec2, DVec3};

use crate::arrays::{affine, matrix, shaped};
use crate::errors::value_error;

/// The near plane of a camera until it is placed.
const UNPLACED_NEAR: f64 = 1.0;

/// A camera: where it is, where it looks, and its lens.
///
/// Make one by `Camera.perspective`, `Camera.orthographic`, `Camera.from_intrinsics`, `Camera.fisheye` or
/// `Camera.look_at`. Without `near` the clip planes are placed so that nothing ahead is cut.
///
/// >>> import trigon3d
/// >>> camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
/// >>> camera.project([[0, 0, 0]], 640, 480)
/// array([[320., 240.]])
#[pyclass(name = "Camera", module = "trigon3d", frozen)]
#[derive(Clone)]
pub(crate) struct PyCamera {
    /// With a lens its projection means nothing.
    pub(crate) camera: Camera,
    pub(crate) lens: Option<FisheyeLens>,
    pub(crate) has_clip_planes: bool,
}

impl From<Camera> for PyCamera {
    /// Its clip planes are placed anew for every scene.
    fn from(camera: Camera) -> Self {
        Self { camera, lens: None, has_clip_planes: false }
    }
}

impl PyCamera {
    pub(crate) fn as_fisheye(&self) -> Option<FisheyeCamera> {
        Some(FisheyeCamera::at(&self.camera, self.lens?))
    }

    /// The camera as it draws a scene within these bounds.
    pub(crate) fn placed(&self, bounds: &Bounds3) -> Camera {
        if self.has_clip_planes { self.camera } else { self.camera.with_clip_planes(bounds) }
    }

    fn new(
        pose: Option<&Bound<'_, PyAny>>,
        axes: CameraAxes,
        projection: Projection,
        planes: Planes,
    ) -> PyResult<Self> {
        let pose = pose.map_or(Ok(DAffine3::IDENTITY), |pose| affine(pose, "pose"))?;
        let projection = planes.of(projection)?;
        let camera = Camera::from_pose(&pose, axes, projection).map_err(value_error)?;
        Ok(Self { camera, lens: None, has_clip_planes: planes.near.is_some() })
    }
}

/// Clip planes that may be given.
#[derive(Clone, Copy)]
struct Planes {
    near: Option<f64>,
    far: Option<f64>,
}

impl Planes {
    fn of(self, projection: Projection) -> PyResult<Projection> {
        match (self.near, self.far) {
            (Some(near), far) => projection.with_planes(near, far).map_err(value_error),
            (None, None) => Ok(projection),
            (None, Some(_)) => Err(value_error("far needs near")),
        }
    }
}

/// "opengl" or "opencv".
fn axes(convention: &str) -> PyResult<CameraAxes> {
    match convention {
        "opengl" => Ok(CameraAxes::OpenGl),
        "opencv" => Ok(CameraAxes::OpenCv),
        other => Err(value_error(format!("convention is {other:?}, not \"opengl\" or \"opencv\""))),
    }
}

#[pymethods]
impl PyCamera {
    /// A perspective camera at a pose, a matrix from the camera to the world.
    ///
    /// `vertical_fov` is in degrees from the lower to the upper edge of the image. With the convention "opengl" the
    /// camera looks along −Z with Y up, with "opencv" along +Z with Y down.
    ///
    /// >>> import numpy, trigon3d
    /// >>> camera = trigon3d.Camera.perspective(40, pose=numpy.eye(4))
    /// >>> camera.forward
    /// (0.0, 0.0, -1.0)
    #[staticmethod]
    #[pyo3(signature = (vertical_fov, *, pose=None, convention="opengl", near=None, far=None))]
    fn perspective(
        vertical_fov: f64,
        pose: Option<&Bound<'_, PyAny>>,
        convention: &str,
        near: Option<f64>,
        far: Option<f64>,
    ) -> PyResult<Self> {
        let lens = Projection::perspective(vertical_fov.to_radians(), UNPLACED_NEAR, None);
        Self::new(pose, axes(convention)?, lens.map_err(value_error)?, Planes { near, far })
    }

    /// A camera without perspective: `height` is that of the view, in the units of the scene.
    ///
    /// >>> import trigon3d
    /// >>> camera = trigon3d.Camera.orthographic(2.0)
    /// >>> camera.K(640, 480) is None
    /// True
    #[staticmethod]
    #[pyo3(signature = (height, *, pose=None, convention="opengl", near=None, far=None))]
    fn orthographic(
        height: f64,
        pose: Option<&Bound<'_, PyAny>>,
        convention: &str,
        near: Option<f64>,
        far: Option<f64>,
    ) -> PyResult<Self> {
        let lens = Projection::orthographic(height, -UNPLACED_NEAR, UNPLACED_NEAR);
        Self::new(pose, axes(convention)?, lens.map_err(value_error)?, Planes { near, far })
    }

    /// A calibrated camera: K in pixels of an image of `width` × `height`.
    ///
    /// The convention is that of the pose, and of K: with "opencv" the centre of the first pixel is at (0, 0), with
    /// "opengl" at (0.5, 0.5). An image of another size shows the same view, scaled.
    ///
    /// >>> import trigon3d
    /// >>> K = [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]]
    /// >>> camera = trigon3d.Camera.from_intrinsics(K, 640, 480, convention="opencv")
    /// >>> camera.project([[0, 0, 2]], 640, 480, convention="opencv")
    /// array([[319.5, 239.5]])
    #[staticmethod]
    #[pyo3(signature = (K, width, height, pose=None, *, convention="opencv", near=None, far=None))]
    #[expect(non_snake_case, reason = "K is the name that everybody knows")]
    fn from_intrinsics(
        K: [[f64; 3]; 3],
        width: u32,
        height: u32,
        pose: Option<&Bound<'_, PyAny>>,
        convention: &str,
        near: Option<f64>,
        far: Option<f64>,
    ) -> PyResult<Self> {
        let Intrinsics { focal, center } = intrinsics(&K)?;
        let axes = axes(convention)?;
        let centers = pixel_centers(axes);
        let image = Viewport { width, height };
        let lens = Projection::pinhole(focal, center, image, centers, UNPLACED_NEAR);
        Self::new(pose, axes, lens.map_err(value_error)?, Planes { near, far })
    }

    /// A fisheye camera: K in pixels of an image of `width` × `height`, and the coefficients (k1, k2, k3, k4) of OpenCV's
    /// `cv2.fisheye`; without them the lens is equidistant.
    ///
    /// A point at the angle θ from the axis is drawn at the distance f·θ·(1 + k1·θ² + k2·θ⁴ + k3·θ⁶ + k4·θ⁸) from the
    /// centre. `fov` is the full angle in degrees that the lens shows; otherwise it ends at 360°, or where the polynomial
    /// ceases to increase. Pixels beyond show the background. The conventions are those of `from_intrinsics`.
    ///
    /// Images are drawn by an exact ray for each sample, with all outputs; `depth` is the distance from the eye. Lines and
    /// points are left out, with a `TrigonWarning`.
    ///
    /// >>> import trigon3d
    /// >>> K = [[100, 0, 199.5], [0, 100, 199.5], [0, 0, 1]]
    /// >>> camera = trigon3d.Camera.fisheye(K, 400, 400, fov=190)
    /// >>> camera.project([[0, 0, 1], [1, 0, 0], [0, 0, -1]], 400, 400, convention="opencv").round(3)
    /// array([[199.5 , 199.5 ],
    ///        [356.58, 199.5 ],
    ///        [   nan,    nan]])
    #[staticmethod]
    #[pyo3(signature = (K, width, height, pose=None, *, convention="opencv", distortion=None, fov=None))]
    #[expect(non_snake_case, reason = "K is the name that everybody knows")]
    fn fisheye(
        K: [[f64; 3]; 3],
        width: u32,
        height: u32,
        pose: Option<&Bound<'_, PyAny>>,
        convention: &str,
        distortion: Option<[f64; 4]>,
        fov: Option<f64>,
    ) -> PyResult<Self> {
        let Intrinsics { focal, center } = intrinsics(&K)?;
        let axes = axes(convention)?;
        let image = Viewport { width, height };
        let terms = distortion.unwrap_or_default();
        let lens = FisheyeLens::new(focal, center, image, pixel_centers(axes), terms);
        let ended = |lens: FisheyeLens| match fov {
            Some(fov) => lens.with_fov(fov.to_radians()),
            None => Ok::<_, CameraError>(lens),
        };
        let lens = lens.and_then(ended).map_err(value_error)?;
        let planes = Planes { near: None, far: None };
        Ok(Self { lens: Some(lens), ..Self::new(pose, axes, Projection::default(), planes)? })
    }

    /// A perspective camera at `position` that looks at `target`.
    ///
    /// >>> import trigon3d
    /// >>> trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0)).position
    /// (0.0, 0.0, 5.0)
    #[staticmethod]
    #[pyo3(signature = (position, target, up=[0.0, 1.0, 0.0], *, vertical_fov=30.0, near=None, far=None))]
    fn look_at(
        position: [f64; 3],
        target: [f64; 3],
        up: [f64; 3],
        vertical_fov: f64,
        near: Option<f64>,
        far: Option<f64>,
    ) -> PyResult<Self> {
        let [position, target, up] = [position, target, up].map(DVec3::from_array);
        if ![position, target, up].iter().all(|vector| vector.is_finite()) {
            return Err(value_error("position, target and up must be finite"));
        }
        if position == target {
            return Err(value_error("position and target are the same point"));
        }
        let lens = Projection::perspective(vertical_fov.to_radians(), UNPLACED_NEAR, None);
        let planes = Planes { near, far };
        let camera =
            Camera::look_at(position, target, up).with_projection(planes.of(lens.map_err(value_error)?)?);
        Ok(Self { camera, lens: None, has_clip_planes: near.is_some() })
    }

    /// The same lens at another pose.
    ///
    /// >>> import numpy, trigon3d
    /// >>> moved = trigon3d.Camera.perspective(40).with_pose(numpy.eye(4), convention="opencv")
    /// >>> moved.forward
    /// (0.0, 0.0, 1.0)
    #[pyo3(signature = (pose, *, convention="opengl"))]
    fn with_pose(&self, pose: &Bound<'_, PyAny>, convention: &str) -> PyResult<Self> {
        let pose = affine(pose, "pose")?;
        let camera =
            Camera::from_pose(&pose, axes(convention)?, self.camera.projection).map_err(value_error)?;
        Ok(Self { camera, ..self.clone() })
    }

    /// The matrix of 4 × 4 from the camera to the world.
    #[pyo3(signature = (convention="opengl"))]
    fn pose<'py>(&self, py: Python<'py>, convention: &str) -> PyResult<Bound<'py, PyAny>> {
        matrix(py, &self.camera.pose(axes(convention)?))
    }

    /// The matrix of 4 × 4 from the world to the camera, as OpenCV's functions take it.
    #[pyo3(signature = (convention="opencv"))]
    fn extrinsics<'py>(&self, py: Python<'py>, convention: &str) -> PyResult<Bound<'py, PyAny>> {
        matrix(py, &self.camera.extrinsics(axes(convention)?))
    }

    /// The matrix K for an image of this size; `None` without perspective.
    ///
    /// >>> import trigon3d
    /// >>> trigon3d.Camera.perspective(90).K(200, 100)
    /// array([[50. ,  0. , 99.5],
    ///        [ 0. , 50. , 49.5],
    ///        [ 0. ,  0. ,  1. ]])
    #[expect(non_snake_case, reason = "K is the name that everybody knows")]
    #[pyo3(signature = (width, height, *, convention="opencv"))]
    fn K<'py>(
        &self,
        py: Python<'py>,
        width: u32,
        height: u32,
        convention: &str,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let centers = pixel_centers(axes(convention)?);
        let image = Viewport { width, height };
        let k = match &self.lens {
            Some(lens) => Some(lens.intrinsics(image, centers)),
            None => self.camera.projection.intrinsics(image, centers),
        };
        k.map(|k| {
            let numbers = vec![k.focal.x, 0.0, k.center.x, 0.0, k.focal.y, k.center.y, 0.0, 0.0, 1.0];
            shaped(py, numbers, &[3, 3])
        })
        .transpose()
    }

    /// Where points of the world are in an image, an array of (n, 2); NaN for points behind the camera, or beyond a
    /// fisheye lens.
    ///
    /// With the convention "opencv" the centre of the first pixel is at (0, 0), with "opengl" at (0.5, 0.5).
    #[pyo3(signature = (points, width, height, *, convention="opengl"))]
    fn project<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'_, PyAny>,
        width: u32,
        height: u32,
        convention: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let shift = if axes(convention)? == CameraAxes::OpenCv { 0.5 } else { 0.0 };
        let image = Viewport { width, height };
        let (projector, fisheye) = (Projector::new(&self.camera, image), self.as_fisheye());
        let pixel_of = |point: DVec3| match &fisheye {
            Some(fisheye) => fisheye.project(point, image),
            None => projector.to_screen(point),
        };
        let points = crate::arrays::points(points, "points")?;
        let pixels = points.iter().flat_map(|&point| {
            let pixel = pixel_of(point).unwrap_or(DVec2::NAN);
            [pixel.x - shift, pixel.y - shift]
        });
        shaped(py, pixels.collect(), &[points.len(), 2])
    }

    /// Where the camera is.
    #[getter]
    fn position(&self) -> (f64, f64, f64) {
        self.camera.position.into()
    }

    /// The direction in which it looks, of length 1.
    #[getter]
    fn forward(&self) -> (f64, f64, f64) {
        // Without negative zeros, which look odd.
        (self.camera.forward() + DVec3::ZERO).into()
    }

    fn __repr__(&self) -> String {
        let Camera { position, .. } = self.camera;
        let [p, f] = [position, self.camera.forward()];
        format!("Camera(position=({}, {}, {}), forward=({}, {}, {}))", p.x, p.y, p.z, f.x, f.y, f.z)
    }
}

/// A matrix K by rows.
fn intrinsics(rows: &[[f64; 3]; 3]) -> PyResult<Intrinsics> {
    let [[fx, skew, cx], [zero, fy, cy], last] = *rows;
    if [skew, zero] != [0.0; 2] || last != [0.0, 0.0, 1.0] {
        return Err(value_error("K is not [fx 0 cx, 0 fy cy, 0 0 1]; skew is not supported"));
    }
    Ok(Intrinsics { focal: DVec2::new(fx, fy), center: DVec2::new(cx, cy) })
}

fn pixel_centers(axes: CameraAxes) -> PixelCenters {
    match axes {
        CameraAxes::OpenGl => PixelCenters::AtHalves,
        CameraAxes::OpenCv => PixelCenters::AtIntegers,
    }
}

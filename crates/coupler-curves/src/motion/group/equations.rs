//! The equations of a group: closed loops of links, each quadratic in the coordinates of the joints.

use std::array::from_fn;

use nalgebra::DMatrix;

use crate::geometry::{Point, Vector, left_normal, trig};
use crate::linkage::{Closure, Group, Input, JointId, JointKind, Linkage};
use crate::motion::joint_series::SeriesInput;
use crate::motion::series::{Scalar, Series, VectorSeries};

/// The equations of a group in `n` unknowns, the coordinates of its joints, and the input.
///
/// A *state* has the unknowns, each two of a joint, and last the input. Lengths are divided by the size of the linkage;
/// an input that is an angle is in radians.
pub(super) struct Equations {
    pub equations: Vec<Equation>,
    /// The joints of the unknowns.
    pub joints: Vec<JointId>,
    /// The length that is 1.
    pub size: f64,
    /// The point of the fixed frame that positions are measured from: one of its joints, for few digits are lost there.
    origin: Vector,
    /// Whether the input is an angle.
    pub is_angle: bool,
}

/// A position that is linear in those of joints, with complex factors: a constant, a multiple of the input (of its
/// direction, if it is an angle), and multiples of unknowns.
#[derive(Clone, Debug)]
pub(super) struct Form {
    pub constant: Vector,
    pub input: Vector,
    pub terms: Vec<(usize, Vector)>,
}

/// `e . f = value` or `e x f = value`, times a factor for which the greatest derivatives are about 1.
pub(super) struct Equation {
    pub e: Form,
    pub f: Form,
    pub is_cross: bool,
    /// The value, and the multiple of the square of the input that is added to it.
    pub value: [f64; 2],
    pub factor: f64,
}

/// The product of complex numbers.
fn times(a: Vector, b: Vector) -> Vector {
    Vector::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

impl Form {
    fn constant(at: Vector) -> Form {
        Form { constant: at, input: Vector::zeros(), terms: Vec::new() }
    }

    fn unknown(k: usize) -> Form {
        Form { terms: vec![(k, Vector::new(1.0, 0.0))], ..Form::constant(Vector::zeros()) }
    }

    fn plus(&self, other: &Form, factor: Vector) -> Form {
        let mut sum = self.clone();
        sum.constant += times(factor, other.constant);
        sum.input += times(factor, other.input);
        for &(k, own) in &other.terms {
            match sum.terms.iter_mut().find(|(known, _)| *known == k) {
                Some((_, term)) => *term += times(factor, own),
                None => sum.terms.push((k, times(factor, own))),
            }
        }
        sum.terms.retain(|(_, factor)| *factor != Vector::zeros());
        sum
    }

    fn minus(&self, other: &Form) -> Form {
        self.plus(other, Vector::new(-1.0, 0.0))
    }

    /// Its value, from those of the unknowns and of the input.
    fn at<T: Scalar, const N: usize>(&self, state: &State<T, N>) -> VectorSeries<T, N> {
        let mut sum = VectorSeries::constant(self.constant);
        let mut add = |factor: Vector, of: &VectorSeries<T, N>| {
            sum = sum.moved(*of, Series::constant(factor.x), Series::constant(factor.y));
        };
        if self.input != Vector::zeros() {
            add(self.input, &state.direction);
        }
        self.terms.iter().for_each(|&(k, factor)| add(factor, &state.unknowns[k]));
        sum
    }
}

/// A state as series in a variable.
struct State<T, const N: usize> {
    unknowns: Vec<VectorSeries<T, N>>,
    /// The direction of an angle; a length and 0.
    direction: VectorSeries<T, N>,
    /// The square of a length; 0 for an angle.
    input_squared: Series<T, N>,
}

/// The equations linearized in a state: in memory that is used again for the next.
#[derive(Default)]
pub(super) struct Linearization {
    /// How far the equations are from holding.
    pub residuals: Vec<f64>,
    /// A row for each equation, with a column for each unknown and one for the input.
    pub jacobian: Vec<f64>,
    unknowns: Vec<VectorSeries<f64, 1>>,
}

impl Equations {
    /// The equations of a linkage's group; `None` if a closure needs a joint whose position is not linear in the
    /// unknowns, such as one on a gear.
    pub fn new(linkage: &Linkage, group: &Group) -> Option<Equations> {
        let size = size(linkage, group);
        let fixed = linkage.joints.iter().find_map(|joint| match joint.kind {
            JointKind::Fixed(at) => Some(at.coords),
            _ => None,
        });
        let origin = fixed.unwrap_or_default();
        let mut joints = Vec::new();
        let mut closures = Vec::new();
        let mut forms: Vec<Option<Form>> = Vec::new();
        let unit = Vector::new(1.0, 0.0);
        for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
            let known = |joint: JointId| forms[joint.index()].clone();
            let form = match joint.kind {
                JointKind::Fixed(at) => Some(Form::constant((at.coords - origin) / size)),
                JointKind::Crank { pivot, length } => known(pivot).map(|pivot| {
                    let arm = Form { input: unit * (length / size), ..Form::constant(Vector::zeros()) };
                    pivot.plus(&arm, unit)
                }),
                JointKind::DrivenSlider { line: [p, q], offset } => known(p).zip(known(q)).map(|(p, q)| {
                    let direction = (q.constant - p.constant).normalize();
                    let across = left_normal(direction) * (offset / size);
                    Form { input: direction, ..Form::constant(p.constant + across) }
                }),
                JointKind::Rigid { base: [p, q], along, across } => {
                    known(p).zip(known(q)).map(|(p, q)| p.plus(&q.minus(&p), Vector::new(along, across)))
                }
                JointKind::Parallelogram { corners: [p, q, r] } => {
                    known(p).zip(known(q)).zip(known(r)).map(|((p, q), r)| p.plus(&r.minus(&q), unit))
                }
                JointKind::Grouped { .. } | JointKind::Piston { .. } => {
                    joints.push(id);
                    Some(Form::unknown(joints.len() - 1))
                }
                _ => None,
            };
            forms.push(form);
        }
        let form = |joint: JointId| forms[joint.index()].clone();
        let at_start = linkage.motion_options.start.unwrap_or(size) / size;
        let driven =
            |rod: Form| Equation { e: rod.clone(), f: rod, is_cross: false, value: [0.0, 1.0], factor: 0.5 / at_start };
        for joint in &linkage.joints {
            let JointKind::Piston { base: [from, pivot], length, .. } = joint.kind else { continue };
            let own = linkage.joint_ids().find(|id| std::ptr::eq(&linkage.joints[*id], joint))?;
            closures.push(Equation::distance(form(own)?.minus(&form(pivot)?), length / size));
            closures.push(driven(form(own)?.minus(&form(from)?)));
        }
        for closure in &group.closures {
            match *closure {
                Closure::Distance { joints: [a, b], length } => {
                    closures.push(Equation::distance(form(a)?.minus(&form(b)?), length / size));
                }
                Closure::Driven { joints: [a, b] } => closures.push(driven(form(a)?.minus(&form(b)?))),
                Closure::OnLink { joint, base: [p, q], along, across } => {
                    let (p, q) = (form(p)?, form(q)?);
                    let place = p.plus(&q.minus(&p), Vector::new(along, across));
                    let miss = form(joint)?.minus(&place);
                    let equation = |is_cross| Equation {
                        e: Form::constant(unit),
                        f: miss.clone(),
                        is_cross,
                        value: [0.0; 2],
                        factor: 1.0,
                    };
                    closures.extend([equation(false), equation(true)]);
                }
                Closure::OnLine { joint, line: [p, q], length, offset } => {
                    let (p, q) = (form(p)?, form(q)?);
                    closures.push(Equation {
                        e: q.minus(&p),
                        f: form(joint)?.minus(&p),
                        is_cross: true,
                        value: [offset * length / (size * size), 0.0],
                        factor: size / length,
                    });
                }
            }
        }
        let is_angle = linkage.input() != Input::Length;
        Some(Equations { equations: closures, joints, size, origin, is_angle })
    }

    /// The number of unknowns.
    pub fn unknown_count(&self) -> usize {
        2 * self.joints.len()
    }

    /// The number of equations.
    pub fn count(&self) -> usize {
        self.equations.len()
    }

    /// A value of the input as it is in a state.
    pub fn input_in_state(&self, value: f64) -> f64 {
        if self.is_angle { trig::radians(value) } else { value / self.size }
    }

    /// The input of a state: an angle in degrees, or a length.
    pub fn input(&self, state: &[f64]) -> f64 {
        self.input_value(state[self.unknown_count()])
    }

    /// A value of the input as it is in a state, as an angle in degrees or a length.
    pub fn input_value(&self, own: f64) -> f64 {
        if self.is_angle { trig::degrees(own) } else { own * self.size }
    }

    /// The whole turn of the input in a state; `None` of a length.
    pub fn turn(&self) -> Option<f64> {
        self.is_angle.then_some(std::f64::consts::TAU)
    }

    /// The positions of the group's joints in a state.
    pub fn positions<'s>(&self, state: &'s [f64]) -> impl Iterator<Item = (JointId, Point)> + use<'_, 's> {
        let at = |k: usize| Point::from(self.origin + Vector::new(state[2 * k], state[2 * k + 1]) * self.size);
        self.joints.iter().enumerate().map(move |(k, &joint)| (joint, at(k)))
    }

    /// A position of a state, and its rates, in the frame of the fixed joints.
    pub fn placed<const N: usize>(&self, at: VectorSeries<f64, N>) -> VectorSeries<f64, N> {
        let mut placed = VectorSeries { x: at.x.scaled(self.size), y: at.y.scaled(self.size) };
        placed.x.0[0] += self.origin.x;
        placed.y.0[0] += self.origin.y;
        placed
    }

    /// The state of a pose.
    pub fn state(&self, position: impl Fn(JointId) -> Point, input: f64) -> Vec<f64> {
        let unknowns = self.joints.iter().flat_map(|&joint| {
            let at = (position(joint).coords - self.origin) / self.size;
            [at.x, at.y]
        });
        unknowns.chain([self.input_in_state(input)]).collect()
    }

    /// The state of the pose of another linkage's state, with the same joints and an angle as the input.
    pub fn state_of(&self, other: &Equations, mut state: Vec<f64>) -> Vec<f64> {
        let n = self.unknown_count();
        let shift = other.origin - self.origin;
        for (k, own) in state[..n].iter_mut().enumerate() {
            *own = (shift[k % 2] + *own * other.size) / self.size;
        }
        state
    }

    /// How far the equations are from holding on a line through a state, as series along it.
    pub fn along_line<T: Scalar, const N: usize>(&self, state: &[T], direction: &[T]) -> Vec<Series<T, N>> {
        let n = self.unknown_count();
        let linear = |k: usize| Series(from_fn(|i| [state[k], direction[k], T::from(0.0)][i.min(2)]));
        let unknowns = (0..n / 2).map(|k| VectorSeries { x: linear(2 * k), y: linear(2 * k + 1) }).collect();
        self.residuals(&self.state_series(unknowns, linear(n)))
    }

    /// How far the equations are from holding, for unknowns as series in a variable, and the input at a value and a
    /// direction, if it is an angle, of which it is the variable.
    pub fn in_input<const N: usize>(
        &self,
        unknowns: Vec<VectorSeries<f64, N>>,
        input: SeriesInput<f64>,
    ) -> Vec<Series<f64, N>> {
        let state = if self.is_angle {
            let direction = VectorSeries::rotating_unit(input.direction, 1.0);
            State { unknowns, direction, input_squared: Series::constant(0.0) }
        } else {
            self.state_series(unknowns, Series::variable(input.value).scaled(1.0 / self.size))
        };
        self.residuals(&state)
    }

    fn state_series<T: Scalar, const N: usize>(
        &self,
        unknowns: Vec<VectorSeries<T, N>>,
        input: Series<T, N>,
    ) -> State<T, N> {
        let zero = Series::constant(0.0);
        if !self.is_angle {
            return State { unknowns, direction: VectorSeries { x: input, y: zero }, input_squared: input.square() };
        }
        // A point on the unit circle whose angle is linear in the variable.
        let [cos, sin] = input.0[0].to_degrees().cos_sin_deg();
        let rate = if N > 1 { input.0[1] } else { T::from(0.0) };
        let (mut x, mut y) = ([cos; N], [sin; N]);
        for n in 1..N {
            let rate = rate / T::from(n as f64);
            (x[n], y[n]) = (-(rate * y[n - 1]), rate * x[n - 1]);
        }
        State { unknowns, direction: VectorSeries { x: Series(x), y: Series(y) }, input_squared: zero }
    }

    fn residuals<T: Scalar, const N: usize>(&self, state: &State<T, N>) -> Vec<Series<T, N>> {
        self.equations.iter().map(|equation| equation.residual(equation.forms_at(state), state)).collect()
    }

    /// The derivatives of the equations: a row for each, with a column for each unknown and one for the input.
    pub fn jacobian<T: Scalar>(&self, state: &[T]) -> Vec<T> {
        let n = self.unknown_count();
        let at = self.constant_state(state, Vec::new());
        let mut out = vec![T::from(0.0); self.count() * (n + 1)];
        self.add_jacobian(&at, state[n], &mut out, |_, _| ());
        out
    }

    /// How far the equations are from holding in a state.
    pub fn residuals_in(&self, state: &[f64]) -> Vec<f64> {
        self.residuals(&self.constant_state(state, Vec::new())).iter().map(|series| series.0[0]).collect()
    }

    /// How far the equations are from holding in a state, with their derivatives as of [`Equations::jacobian`].
    pub fn linearized(&self, state: &[f64], at: &mut Linearization) {
        let n = self.unknown_count();
        at.jacobian.clear();
        at.jacobian.resize(self.count() * (n + 1), 0.0);
        at.residuals.clear();
        let there = self.constant_state(state, std::mem::take(&mut at.unknowns));
        let residuals = &mut at.residuals;
        self.add_jacobian(&there, state[n], &mut at.jacobian, |equation, forms| {
            residuals.push(equation.residual(forms, &there).0[0]);
        });
        at.unknowns = there.unknowns;
    }

    /// A state without a variable, in memory that is used again.
    fn constant_state<T: Scalar>(&self, state: &[T], mut unknowns: Vec<VectorSeries<T, 1>>) -> State<T, 1> {
        let n = self.unknown_count();
        let constant = |k: usize| Series([state[k]]);
        unknowns.clear();
        unknowns.extend((0..n / 2).map(|k| VectorSeries { x: constant(2 * k), y: constant(2 * k + 1) }));
        self.state_series(unknowns, constant(n))
    }

    /// Adds the derivatives in a state to rows of zeros, and gives each equation with its forms there.
    fn add_jacobian<T: Scalar>(
        &self,
        at: &State<T, 1>,
        input: T,
        out: &mut [T],
        mut each: impl FnMut(&Equation, [VectorSeries<T, 1>; 2]),
    ) {
        let n = self.unknown_count();
        let (cos, sin) = (at.direction.x.0[0], at.direction.y.0[0]);
        // The derivative of the direction of an angle, or of a length.
        let turning = if self.is_angle { [-sin, cos] } else { [T::from(1.0), T::from(0.0)] };
        for (equation, row) in self.equations.iter().zip(out.chunks_exact_mut(n + 1)) {
            let [e, f] = equation.forms_at(at);
            each(equation, [e, f]);
            let factor = T::from(equation.factor);
            // The product changes by the real part of the conjugate of `along` times the change of a form.
            let mut add = |form: &Form, [u, v]: [T; 2]| {
                let part = |c: Vector| [T::from(c.x) * u + T::from(c.y) * v, T::from(c.x) * v - T::from(c.y) * u];
                for &(k, c) in &form.terms {
                    let [x, y] = part(c);
                    row[2 * k] = row[2 * k] + x * factor;
                    row[2 * k + 1] = row[2 * k + 1] + y * factor;
                }
                if form.input != Vector::zeros() {
                    let [x, y] = part(form.input);
                    row[n] = row[n] + (x * turning[0] + y * turning[1]) * factor;
                }
            };
            let [ex, ey, fx, fy] = [e.x.0[0], e.y.0[0], f.x.0[0], f.y.0[0]];
            if equation.is_cross {
                add(&equation.f, [-ey, ex]);
                add(&equation.e, [fy, -fx]);
            } else {
                add(&equation.f, [ex, ey]);
                add(&equation.e, [fx, fy]);
            }
            let squared = equation.value[1];
            if squared != 0.0 {
                row[n] = row[n] - T::from(2.0 * squared) * input * factor;
            }
        }
    }

    /// The derivatives as a matrix, without the column of one unknown.
    pub fn matrix_without(&self, jacobian: &[f64], column: usize) -> DMatrix<f64> {
        let n = self.unknown_count();
        DMatrix::from_fn(self.count(), n, |row, k| jacobian[row * (n + 1) + k + usize::from(k >= column)])
    }
}

impl Equation {
    fn forms_at<T: Scalar, const N: usize>(&self, state: &State<T, N>) -> [VectorSeries<T, N>; 2] {
        [self.e.at(state), self.f.at(state)]
    }

    /// How far it is from holding in a state with these forms.
    fn residual<T: Scalar, const N: usize>(
        &self,
        [e, f]: [VectorSeries<T, N>; 2],
        state: &State<T, N>,
    ) -> Series<T, N> {
        let product = if self.is_cross { e.cross(f) } else { e.dot(f) };
        let [value, squared] = self.value;
        let excess = product - Series::constant(value) - state.input_squared.scaled(squared);
        excess.scaled(self.factor)
    }

    fn distance(between: Form, length: f64) -> Equation {
        Equation {
            e: between.clone(),
            f: between,
            is_cross: false,
            value: [length * length, 0.0],
            factor: 0.5 / length,
        }
    }
}

/// The greatest extent of the fixed joints and of the pose at the start, and the crank's length.
fn size(linkage: &Linkage, group: &Group) -> f64 {
    let fixed = linkage.joints.iter().filter_map(|joint| match joint.kind {
        JointKind::Fixed(at) => Some(at),
        _ => None,
    });
    let points: Vec<Point> = fixed.chain(group.joints.iter().map(|(_, at)| *at)).collect();
    let extent = |coordinate: fn(&Point) -> f64| {
        let [low, high] = points
            .iter()
            .map(coordinate)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        high - low
    };
    extent(|p| p.x).max(extent(|p| p.y)).max(linkage.crank_length().unwrap_or(0.0))
}

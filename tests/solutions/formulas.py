"""Right and wrong formulas, numbers and functions, written from the prompts alone.

Expressions and numbers are texts as they stand behind `=` in a cell; functions are whole cells.
"""

# ruff: noqa: E501

RIGHT: dict[str, list[str]] = {
    "Q2.2a": [
        "2*N*r - 2*sum_x*cos(alpha) - 2*sum_y*sin(alpha)",
        "2*N*(r - x_c*cos(alpha) - y_c*sin(alpha))",
        "-2*(sum_x*cos(alpha) + sum_y*sin(alpha) - N*r)",
        "2*(r*N - N*x_c*cos(alpha) - sum_y*sin(alpha))",
        "N*(2*r - 2*(x_c*cos(alpha) + y_c*sin(alpha)))",
        "diff(N*r**2 - 2*r*(sum_x*cos(alpha) + sum_y*sin(alpha)), r)",
        "2*N*r - 2*N*sqrt(x_c**2 + y_c**2)*cos(alpha - atan2(y_c, x_c))",
        "(r*N - sum_x*cos(alpha) - sum_y*sin(alpha))/Rational(1, 2)",
        "2*sum_x*(r/x_c - cos(alpha)) - 2*sum_y*sin(alpha)",
        "2*N*r - sum_x*(exp(I*alpha) + exp(-I*alpha)) - 2*sum_y*cos(pi/2 - alpha)",
        "Matrix([N, -sum_x, -sum_y]).dot(Matrix([2*r, 2*cos(alpha), 2*sin(alpha)]))",
        "limit((N*((r + t)**2 - r**2) - 2*t*(sum_x*cos(alpha) + sum_y*sin(alpha)))/t, t, 0)",
        "2.0*(N*r - sum_x*cos(alpha) - N*y_c*sin(alpha))",
        "integrate(2*N, (q, 0, r)) - 2*(sum_x*cos(alpha) + sum_y*sin(alpha))",
        "2*N*r - 2*sum_x*sin(alpha + pi/2) - 2*sum_y*sin(alpha)",
        "expand_trig(2*N*(r - x_c*cos(alpha + pi - pi) - y_c*sin(alpha)))",
        "2*N*r - 2*sum_x*cos(-alpha) + 2*sum_y*sin(-alpha)",
    ],
    "Q2.2b": [
        "x_c*cos(alpha) + y_c*sin(alpha)",
        "(sum_x*cos(alpha) + sum_y*sin(alpha))/N",
        "sum_x/N*cos(alpha) + y_c*sin(alpha)",
        "Matrix([[cos(alpha), sin(alpha)]]) * Matrix([x_c, y_c])",
        "solve(2*N*r - 2*sum_x*cos(alpha) - 2*sum_y*sin(alpha), r)[0]",
        "solveset(N*r - N*x_c*cos(alpha) - N*y_c*sin(alpha), r)",
        "cos(alpha)*(x_c + y_c*tan(alpha))",
        "re((x_c + I*y_c)*exp(-I*alpha))",
        "sqrt(x_c**2 + y_c**2)*cos(atan2(y_c, x_c) - alpha)",
        "x_c*sin(pi/2 - alpha) + y_c*cos(pi/2 - alpha)",
        "[x_c*cos(alpha) + y_c*sin(alpha)]",
        "x_c*(1 - 2*sin(alpha/2)**2) + 2*y_c*sin(alpha/2)*cos(alpha/2)",
        "1.0*x_c*cos(alpha) + 1.0*y_c*sin(alpha)",
        "-(-sum_x*cos(alpha) - sum_y*sin(alpha))/N",
        "(x_c + y_c)/2*(cos(alpha) + sin(alpha)) + (x_c - y_c)/2*(cos(alpha) - sin(alpha))",
        "sum_x*cos(alpha)/N + sum_y*sin(alpha)/N",
    ],
    "Q2.2c": [
        "S_xx*cos(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)**2",
        "S_xx*cos(alpha)**2 + S_yy*sin(alpha)**2 + S_xy*sin(2*alpha)",
        "(S_xx + S_yy)/2 + (S_xx - S_yy)/2*cos(2*alpha) + S_xy*sin(2*alpha)",
        "S_xx + (S_yy - S_xx)*sin(alpha)**2 + S_xy*sin(2*alpha)",
        "S_yy + (S_xx - S_yy)*cos(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha)",
        "Matrix([[cos(alpha), sin(alpha)]])*Matrix([[S_xx, S_xy], [S_xy, S_yy]])*Matrix([cos(alpha), sin(alpha)])",
        "cos(alpha)**2*(S_xx + 2*S_xy*tan(alpha) + S_yy*tan(alpha)**2)",
        "(S_xx + 2*S_xy*tan(alpha) + S_yy*tan(alpha)**2)/(1 + tan(alpha)**2)",
        "cos(alpha)*(S_xx*cos(alpha) + S_xy*sin(alpha)) + sin(alpha)*(S_xy*cos(alpha) + S_yy*sin(alpha))",
        "0.5*S_xx*(1 + cos(2*alpha)) + 0.5*S_yy*(1 - cos(2*alpha)) + S_xy*sin(2*alpha)",
        "(S_xx + S_yy)/2 + sqrt((S_xx - S_yy)**2/4 + S_xy**2)*cos(2*alpha - atan2(2*S_xy, S_xx - S_yy))",
        "S_xx*cos(alpha)**2 + S_yy*(1 - cos(alpha)**2) + S_xy*cos(2*alpha - pi/2)",
        "trace(Matrix([[S_xx, S_xy], [S_xy, S_yy]])*Matrix([[cos(alpha)**2, sin(alpha)*cos(alpha)], [sin(alpha)*cos(alpha), sin(alpha)**2]]))",
        "S_xx*cos(alpha)**2 + S_yy*sin(alpha)**2 - 2*S_xy*sin(-alpha)*cos(alpha)",
        "(S_xx + S_yy)/2 + re((S_xx - S_yy - 2*I*S_xy)*exp(2*I*alpha))/2",
        "simplify(S_xx*cos(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)**2)",
    ],
    "Q2.2d": [
        "(S_yy - S_xx)*sin(2*alpha) + 2*S_xy*cos(2*alpha)",
        "2*(S_yy - S_xx)*sin(alpha)*cos(alpha) + 2*S_xy*(cos(alpha)**2 - sin(alpha)**2)",
        "-2*S_xx*cos(alpha)*sin(alpha) + 2*S_yy*sin(alpha)*cos(alpha) + 2*S_xy*cos(2*alpha)",
        "diff(S_xx*cos(alpha)**2 + S_yy*sin(alpha)**2 + S_xy*sin(2*alpha), alpha)",
        "S_yy*sin(2*alpha) - S_xx*sin(2*alpha) + 2*S_xy - 4*S_xy*sin(alpha)**2",
        "2*S_xy*(2*cos(alpha)**2 - 1) - (S_xx - S_yy)*sin(2*alpha)",
        "cos(2*alpha)*(2*S_xy - (S_xx - S_yy)*tan(2*alpha))",
        "2*(cos(alpha)*S_xx + sin(alpha)*S_xy)*(-sin(alpha)) + 2*(cos(alpha)*S_xy + sin(alpha)*S_yy)*cos(alpha)",
        "sqrt((S_yy - S_xx)**2 + 4*S_xy**2)*sin(2*alpha + atan2(2*S_xy, S_yy - S_xx))",
        "im((S_yy - S_xx + 2*I*S_xy)*exp(2*I*alpha))",
        "2*Matrix([[-sin(alpha), cos(alpha)]])*Matrix([[S_xx, S_xy], [S_xy, S_yy]])*Matrix([cos(alpha), sin(alpha)])",
        "S_xx*(cos(2*alpha + pi/2)) - S_yy*cos(2*alpha + pi/2) + 2*S_xy*cos(2*alpha)",
        "2*cos(alpha)**2*((S_yy - S_xx)*tan(alpha) + S_xy*(1 - tan(alpha)**2))",
        "Derivative((S_xx - S_yy)/2*cos(2*alpha) + S_xy*sin(2*alpha), alpha).doit()",
        "-1.0*(S_xx - S_yy)*sin(2*alpha) + 2.0*S_xy*cos(2*alpha)",
        "[(S_yy - S_xx)*sin(2*alpha) + 2*S_xy*cos(2*alpha)]",
    ],
    "Q2.2e": [
        "atan(2*S_xy/(S_xx - S_yy))/2",
        "atan2(2*S_xy, S_xx - S_yy)/2",
        "atan2(-2*S_xy, S_yy - S_xx)/2",
        "-atan(2*S_xy/(S_yy - S_xx))/2",
        "atan(-2*S_xy/(S_yy - S_xx))/2 + pi/2",
        "atan((S_yy - S_xx + sqrt((S_yy - S_xx)**2 + 4*S_xy**2))/(2*S_xy))",
        "atan((S_yy - S_xx - sqrt((S_xx - S_yy)**2 + 4*S_xy**2))/(2*S_xy))",
        "Rational(1, 2)*atan(S_xy/((S_xx - S_yy)/2))",
        "pi/4 - atan((S_xx - S_yy)/(2*S_xy))/2",
        "acot((S_xx - S_yy)/(2*S_xy))/2",
        "0.5*atan2(2*S_xy, S_xx - S_yy) + 7*pi",
        "atan(S_xy/((S_xx + S_yy + sqrt((S_xx - S_yy)**2 + 4*S_xy**2))/2 - S_yy))",
        "arg(S_xx - S_yy + 2*I*S_xy)/2",
        "asin(2*S_xy/sqrt((S_xx - S_yy)**2 + 4*S_xy**2)*sign(S_xx - S_yy))/2",
        "atan2(sqrt((S_xx - S_yy)**2 + 4*S_xy**2) - S_xx + S_yy, 2*S_xy)",
        "Piecewise((atan(2*S_xy/(S_xx - S_yy))/2, S_xx > S_yy), (atan(2*S_xy/(S_xx - S_yy))/2 - pi/2, True))",
        "[atan2(2*S_xy, S_xx - S_yy)/2, atan2(2*S_xy, S_xx - S_yy)/2 + pi/2]",
    ],
    "Q2.2f1": [
        "2*(S_yy - S_xx)*cos(2*alpha) - 4*S_xy*sin(2*alpha)",
        "2*(S_yy - S_xx)*(cos(alpha)**2 - sin(alpha)**2) - 8*S_xy*sin(alpha)*cos(alpha)",
        "diff((S_yy - S_xx)*sin(2*alpha) + 2*S_xy*cos(2*alpha), alpha)",
        "diff(S_xx*cos(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)**2, alpha, 2)",
        "-4*((S_xx - S_yy)/2*cos(2*alpha) + S_xy*sin(2*alpha))",
        "2*(S_xx + S_yy) - 4*(S_xx*cos(alpha)**2 + S_xy*sin(2*alpha) + S_yy*sin(alpha)**2)",
        "2*S_yy*cos(2*alpha) - 2*S_xx*cos(2*alpha) - 4*S_xy*sin(2*alpha)",
        "2*(S_yy - S_xx)*(1 - 2*sin(alpha)**2) - 4*S_xy*sin(2*alpha)",
        "2*re((S_yy - S_xx + 2*I*S_xy)*exp(2*I*alpha))",
        "2*sqrt((S_yy - S_xx)**2 + 4*S_xy**2)*cos(2*alpha + atan2(2*S_xy, S_yy - S_xx))",
        "2*cos(2*alpha)*(S_yy - S_xx - 2*S_xy*tan(2*alpha))",
        "-2*(S_xx - S_yy)*cos(2*alpha) - 8*S_xy*sin(alpha)*cos(alpha)",
        "2*(S_xx*sin(alpha)**2 - S_xx*cos(alpha)**2 + S_yy*cos(alpha)**2 - S_yy*sin(alpha)**2 - 2*S_xy*sin(2*alpha))",
        "4*(S_yy - S_xx)*cos(alpha)**2 - 2*(S_yy - S_xx) - 4*S_xy*sin(2*alpha)",
        "2.0*(S_yy - S_xx)*sin(2*alpha + pi/2) + 4.0*S_xy*cos(2*alpha + pi/2)",
        "Derivative(S_xy*sin(2*alpha) + (S_xx - S_yy)/2*cos(2*alpha), (alpha, 2)).doit()",
    ],
    "Q2.2f2": [
        "atan2(-2*S_xy, S_yy - S_xx)/2",
        "Rational(1, 2)*atan2(-2*S_xy, S_yy - S_xx) + pi",
        "atan2(2*S_xy, S_xx - S_yy)/2 + pi/2",
        "atan2(2*S_xy, S_xx - S_yy)/2 - pi/2",
        "-atan2(2*S_xy, S_yy - S_xx)/2",
        "Piecewise((atan(-2*S_xy/(S_yy - S_xx))/2, S_yy > S_xx), (atan(-2*S_xy/(S_yy - S_xx))/2 + pi/2, True))",
        "Piecewise((atan(2*S_xy/(S_xx - S_yy))/2 + pi/2, S_xx > S_yy), (atan(2*S_xy/(S_xx - S_yy))/2, True))",
        "arg(S_yy - S_xx - 2*I*S_xy)/2",
        "atan((S_yy - S_xx - sqrt((S_yy - S_xx)**2 + 4*S_xy**2))/(2*S_xy))",
        "atan2(-2*S_xy, S_yy - S_xx + sqrt((S_yy - S_xx)**2 + 4*S_xy**2))",
        "atan2(S_yy - S_xx - sqrt((S_yy - S_xx)**2 + 4*S_xy**2), 2*S_xy)",
        "pi/2 + atan2(sqrt((S_xx - S_yy)**2 + 4*S_xy**2) - S_xx + S_yy, 2*S_xy)",
        "atan(-S_xy/(S_yy - (S_xx + S_yy - sqrt((S_xx - S_yy)**2 + 4*S_xy**2))/2))",
        "0.5*atan2(-2*S_xy, S_yy - S_xx)",
        "-acos((S_yy - S_xx)/sqrt((S_yy - S_xx)**2 + 4*S_xy**2))*sign(S_xy)/2",
        "im(log(S_yy - S_xx - 2*I*S_xy))/2",
        "-sign(S_xy)*(pi/4 - atan((S_yy - S_xx)/(2*Abs(S_xy)))/2)",
    ],
    "Q3.2.3b": [
        "0.18",
        "0.180",
        "0.1800",
        "0.18005",
        "0.1800494",
        "0.96**42",
        "(1 - 0.2**2)**42",
        "round(0.96**42, 2)",
        "round(0.96**42, 3)",
        "math.exp(42*math.log(0.96))",
        "math.exp(42*math.log1p(-0.04))",
        "np.prod(np.full(42, 0.96))",
        "np.power(0.96, 42)",
        "Fraction(24, 25)**42",
        "Decimal('0.96')**42",
        "Rational(24, 25)**42",
        "Float('0.96')**42",
        "np.float32(0.96**42)",
        "[0.96**42]",
        "np.array(0.18)",
        "1 - (1 - 0.96**42)",
        "math.comb(42, 0)*0.04**0*0.96**42",
        "float(f'{0.96**42:.4f}')",
        "(1 - 0.2*0.2)**42",
        "math.pow(1 - math.pow(0.2, 2), 42)",
        "np.round(0.96**42, 2)",
        "0.96**20*0.96**22",
        "((0.8*0.8) + 2*0.2*0.8)**42",
        "18/100",
        "sum([0.96**42])",
    ],
    "Q3.2.4": [
        "0.98",
        "0.983",
        "0.9831",
        "0.98313",
        "0.983129",
        "1 - 0.96**100",
        "1 - (1 - 0.2**2)**100",
        "round(1 - 0.96**100, 2)",
        "round(1 - 0.96**100, 3)",
        "-math.expm1(100*math.log1p(-0.04))",
        "1 - math.exp(100*math.log(0.96))",
        "sum(0.96**i*0.04 for i in range(100))",
        "1 - Fraction(24, 25)**100",
        "1 - Decimal('0.96')**100",
        "1 - Rational(24, 25)**100",
        "np.float32(1 - 0.96**100)",
        "[1 - 0.96**100]",
        "np.array([0.983])",
        "98.3/100",
        "1 - np.prod(np.repeat(0.96, 100))",
        "sum(math.comb(100, i)*0.04**i*0.96**(100 - i) for i in range(1, 101))",
        "float(f'{1 - 0.96**100:.3f}')",
        "(1 - 0.96)*(1 - 0.96**100)/(1 - 0.96)",
        "1 - 0.96**42*0.96**58",
        "sp.N(1 - Rational(24, 25)**100, 5)",
        "1 - math.pow(0.96, 100)",
    ],
}

WRONG: dict[str, list[str]] = {
    "Q2.2a": [
        "N*r - sum_x*cos(alpha) - sum_y*sin(alpha)",
        "2*(r - x_c*cos(alpha) - y_c*sin(alpha))",
        "2*r - 2*sum_x*cos(alpha) - 2*sum_y*sin(alpha)",
        "-2*(N*r - sum_x*cos(alpha) - sum_y*sin(alpha))",
        "2*(N*r - sum_x*sin(alpha) - sum_y*cos(alpha))",
        "2*(N*r + sum_x*cos(alpha) + sum_y*sin(alpha))",
        "2*(N*r - sum_x*cos(alpha) + sum_y*sin(alpha))",
        "2*(N*r - sum_x*cos(alpha) - sum_y*sin(alpha))**2",
        "2*(N*r - x_c*cos(alpha) - y_c*sin(alpha))",
        "2*N*(r - sum_x*cos(alpha) - sum_y*sin(alpha))",
        "2*N*r",
        "2*N*(sum_x*sin(alpha) - sum_y*cos(alpha))",
        "2*(N*r - sum_x*cos(alpha) - sum_y*sin(alpha)) + 0.001*alpha",
        "4*(N*r - sum_x*cos(alpha) - sum_y*sin(alpha))",
        "2*(N*r - sum_y*cos(alpha) - sum_x*sin(alpha))",
        "2*(N*r - sum_x*cos(2*alpha) - sum_y*sin(2*alpha))",
        "2*(N*r - sum_x - sum_y)",
        "0",
    ],
    "Q2.2b": [
        "x_c*sin(alpha) + y_c*cos(alpha)",
        "x_c*cos(alpha) - y_c*sin(alpha)",
        "-(x_c*cos(alpha) + y_c*sin(alpha))",
        "sum_x*cos(alpha) + sum_y*sin(alpha)",
        "(x_c*cos(alpha) + y_c*sin(alpha))/N",
        "(x_c*cos(alpha) + y_c*sin(alpha))/2",
        "2*(x_c*cos(alpha) + y_c*sin(alpha))",
        "sqrt(x_c**2 + y_c**2)",
        "x_c + y_c",
        "Abs(x_c*cos(alpha) + y_c*sin(alpha))",
        "N*(x_c*cos(alpha) + y_c*sin(alpha))",
        "x_c*cos(alpha)",
        "y_c*sin(alpha)",
        "r",
        "x_c*cos(alpha)**2 + y_c*sin(alpha)**2",
        "x_c*cos(alpha) + sum_y*sin(alpha)",
        "x_c/cos(alpha) + y_c/sin(alpha)",
        "[x_c*cos(alpha) + y_c*sin(alpha), 0]",
    ],
    "Q2.2c": [
        "S_xx*cos(alpha)**2 + S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)**2",
        "S_xx*cos(alpha)**2 - 2*S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)**2",
        "S_xx*sin(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha) + S_yy*cos(alpha)**2",
        "S_xx*cos(alpha)**2 + S_yy*sin(alpha)**2",
        "S_xx*cos(alpha) + 2*S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)",
        "S_xx*cos(alpha)**2 + 2*S_xy*sin(2*alpha) + S_yy*sin(alpha)**2",
        "(S_xx*cos(alpha) + S_yy*sin(alpha))**2",
        "S_xx + S_yy + 2*S_xy",
        "S_xx**2*cos(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha) + S_yy**2*sin(alpha)**2",
        "-S_xx*cos(alpha)**2 - 2*S_xy*sin(alpha)*cos(alpha) - S_yy*sin(alpha)**2",
        "(S_xx*cos(alpha)**2 + 2*S_xy*sin(alpha)*cos(alpha) + S_yy*sin(alpha)**2)/2",
        "(S_xx - S_yy)*cos(2*alpha) + 2*S_xy*sin(2*alpha)",
        "(S_xx + S_yy)/2 - (S_xx - S_yy)/2*cos(2*alpha) + S_xy*sin(2*alpha)",
        "S_xx*cos(alpha)**2 - S_yy*sin(alpha)**2 + S_xy*sin(2*alpha)",
        "S_xx*cos(2*alpha) + 2*S_xy*sin(2*alpha)*cos(2*alpha) + S_yy*sin(2*alpha)",
        "(S_xx - S_yy)/2*cos(2*alpha) + S_xy*sin(2*alpha)",
    ],
    "Q2.2d": [
        "(S_xx - S_yy)*sin(2*alpha) + 2*S_xy*cos(2*alpha)",
        "(S_xx - S_yy)*sin(2*alpha) - 2*S_xy*cos(2*alpha)",
        "(S_yy - S_xx)*sin(2*alpha) + S_xy*cos(2*alpha)",
        "(S_yy - S_xx)*sin(2*alpha) - 2*S_xy*cos(2*alpha)",
        "2*(S_yy - S_xx)*sin(2*alpha) + 2*S_xy*cos(2*alpha)",
        "(S_yy - S_xx)*cos(2*alpha) + 2*S_xy*sin(2*alpha)",
        "(S_yy + S_xx)*sin(2*alpha) + 2*S_xy*cos(2*alpha)",
        "(S_yy - S_xx)*sin(2*alpha)",
        "2*S_xy*cos(2*alpha)",
        "(S_yy - S_xx)*sin(alpha)*cos(alpha) + S_xy*cos(2*alpha)",
        "2*(S_yy - S_xx)*cos(2*alpha) - 4*S_xy*sin(2*alpha)",
        "S_xx*cos(alpha)**2 + S_yy*sin(alpha)**2 + S_xy*sin(2*alpha)",
        "(S_yy - S_xx)*sin(alpha) + 2*S_xy*cos(alpha)",
        "(S_yy - S_xx)*sin(2*alpha) + 2*S_xy*(cos(alpha)**2 + sin(alpha)**2)",
        "2*S_yy*sin(alpha) - 2*S_xx*cos(alpha) + 2*S_xy*cos(2*alpha)",
        "0",
    ],
    "Q2.2e": [
        "atan(2*S_xy/(S_yy - S_xx))/2",
        "atan(2*S_xy/(S_xx - S_yy))",
        "atan(S_xy/(S_xx - S_yy))/2",
        "atan((S_xx - S_yy)/(2*S_xy))/2",
        "2*S_xy/(S_xx - S_yy)/2",
        "tan(2*S_xy/(S_xx - S_yy))/2",
        "atan(2*S_xy/(S_xx + S_yy))/2",
        "atan2(2*S_xy, S_yy - S_xx)/2",
        "atan2(S_xx - S_yy, 2*S_xy)/2",
        "atan2(2*S_xy, S_xx - S_yy)/2 + pi/4",
        "atan2(2*S_xy, S_xx - S_yy)/2*180/pi",
        "2*atan2(2*S_xy, S_xx - S_yy)",
        "atan(S_yy/S_xx)",
        "atan(S_xy/S_xx)",
        "atan2(S_xy, S_xx - S_yy)/2",
        "atan2(4*S_xy, S_xx - S_yy)/2",
        "[atan2(2*S_xy, S_xx - S_yy)/2, atan2(2*S_xy, S_xx - S_yy)]",
        "pi/2",
    ],
    "Q2.2f1": [
        "2*(S_xx - S_yy)*cos(2*alpha) - 4*S_xy*sin(2*alpha)",
        "2*(S_yy - S_xx)*cos(2*alpha) + 4*S_xy*sin(2*alpha)",
        "(S_yy - S_xx)*cos(2*alpha) - 2*S_xy*sin(2*alpha)",
        "2*(S_yy - S_xx)*cos(2*alpha) - 2*S_xy*sin(2*alpha)",
        "(S_yy - S_xx)*cos(2*alpha) - 4*S_xy*sin(2*alpha)",
        "-2*(S_yy - S_xx)*cos(2*alpha) + 4*S_xy*sin(2*alpha)",
        "(S_yy - S_xx)*sin(2*alpha) + 2*S_xy*cos(2*alpha)",
        "2*(S_yy + S_xx)*cos(2*alpha) - 4*S_xy*sin(2*alpha)",
        "2*(S_yy - S_xx)*cos(2*alpha)",
        "-4*S_xy*sin(2*alpha)",
        "4*(S_yy - S_xx)*cos(2*alpha) - 8*S_xy*sin(2*alpha)",
        "2*(S_yy - S_xx)*sin(2*alpha) - 4*S_xy*cos(2*alpha)",
        "2*(S_yy - S_xx)*cos(alpha) - 4*S_xy*sin(alpha)",
        "2*sqrt((S_yy - S_xx)**2 + 4*S_xy**2)",
        "-4*(S_yy - S_xx)*sin(2*alpha) - 8*S_xy*cos(2*alpha)",
        "2*(S_yy - S_xx)*cos(alpha)**2 - 4*S_xy*sin(2*alpha)",
    ],
    "Q2.2f2": [
        "atan(-2*S_xy/(S_yy - S_xx))/2",
        "atan2(2*S_xy, S_xx - S_yy)/2",
        "atan2(-2*S_xy, S_yy - S_xx)/2 + pi/2",
        "atan2(2*S_xy, S_yy - S_xx)/2",
        "atan2(S_yy - S_xx, -2*S_xy)/2",
        "atan2(-2*S_xy, S_yy - S_xx)",
        "atan2(-S_xy, S_yy - S_xx)/2",
        "atan2(-2*S_xy, S_yy + S_xx)/2",
        "atan(2*S_xy/(S_xx - S_yy))/2 + pi/2",
        "Piecewise((atan(-2*S_xy/(S_yy - S_xx))/2, S_yy < S_xx), (atan(-2*S_xy/(S_yy - S_xx))/2 + pi/2, True))",
        "Piecewise((atan(-2*S_xy/(S_yy - S_xx))/2, S_xy > 0), (atan(-2*S_xy/(S_yy - S_xx))/2 + pi/2, True))",
        "atan((S_yy - S_xx + sqrt((S_yy - S_xx)**2 + 4*S_xy**2))/(2*S_xy))",
        "Abs(atan2(-2*S_xy, S_yy - S_xx))/2",
        "acos((S_yy - S_xx)/sqrt((S_yy - S_xx)**2 + 4*S_xy**2))/2",
        "asin(-2*S_xy/sqrt((S_yy - S_xx)**2 + 4*S_xy**2))/2",
        "atan2(-2*S_xy, Abs(S_yy - S_xx))/2",
        "[atan2(-2*S_xy, S_yy - S_xx)/2, atan2(-2*S_xy, S_yy - S_xx)/2 + pi/2]",
        "atan2(-2*S_xy, S_yy - S_xx)*90/pi",
    ],
    "Q3.2.3b": [
        "0.96", "0.82", "1 - 0.96**42", "0.8**42", "0.2**42", "0.04**42", "0.04*42", "18", "18.0",
        "0.17", "0.19", "0.96**43", "0.96**41", "(1 - 0.2)**42", "(1 - 0.2**3)**42", "0.64**42",
        "0.36**42", "0.1", "0.2", "1.8", "0", "1", "0.0018", "math.exp(-42*0.04)", "0.1806",
        "-0.18", "'0.18'", "None", "float('nan')", "[0.18, 0.82]",
    ],
    "Q3.2.4": [
        "0.02", "0.017", "0.96**100", "0.99", "0.97", "1", "1.0", "98", "98.31", "1 - 0.8**100",
        "1 - 0.04**100", "1 - 0.2**100", "1 - 0.96**99", "1 - 0.96**101", "1 - 0.96**42",
        "0.96**42*0.04**58", "0.04*100", "1 - math.exp(-100*0.04)", "0.04**100", "1 - 0.992**100",
        "0.9", "0.985", "0.9841", "-0.98", "'0.98'", "1 - 0.64**100", "0.83", "float('inf')",
    ],
}  # fmt: skip

_HEAD = "def required_iterations(p, w, s):\n"
_GUARD = "    if not 0 < p < 1 or not 0 <= w <= 1:\n        raise ValueError('out of range')\n"
_EDGES = "    if w == 1:\n        return 1\n    if w == 0:\n        return math.inf\n"
_START = _HEAD + _GUARD + _EDGES

RIGHT["Q3.3"] = [
    _START + "    q = w**s\n    return max(1, math.ceil(math.log1p(-p) / math.log1p(-q) - 1e-9))\n",
    _START + "    return int(np.ceil(np.log1p(-p) / np.log1p(-(w**s)) * (1 - 1e-14)))\n",
    _START
    + "    q = math.exp(s * math.log(w))\n"
    "    return math.ceil(math.log1p(-p) / math.log1p(-q) * (1 - 1e-13))\n",
    # Sixty digits.
    "from decimal import Decimal, getcontext\n"
    + _START
    + "    getcontext().prec = 60\n"
    "    k = (1 - Decimal(p)).ln() / (1 - Decimal(w) ** int(s)).ln()\n"
    "    return int(k.to_integral_value(rounding='ROUND_CEILING'))\n",
    # Sympy's numbers.
    _START
    + "    one = sp.Integer(1)\n"
    "    q = sp.Rational(w) ** int(s)\n"
    "    return int(sp.ceiling(sp.log(1 - sp.Rational(p)).evalf(80) / sp.log(one - q).evalf(80)))\n",
    # Bisection between whole numbers.
    _START
    + "    each, wanted = math.log1p(-(w**s)), math.log1p(-p)\n"
    "    high = 1\n"
    "    while high * each > wanted:\n        high *= 2\n"
    "    low = high // 2\n"
    "    while high - low > 1:\n"
    "        middle = (low + high) // 2\n"
    "        if middle * each > wanted:\n            low = middle\n"
    "        else:\n            high = middle\n"
    "    return high\n",
    # The logarithm by its inverse hyperbolic tangent.
    _START
    + "    def log_of_rest(x):\n        return -2 * math.atanh(x / (2 - x))\n"
    "    return math.ceil(log_of_rest(p) / log_of_rest(w**s) * (1 - 1e-13))\n",
    # A series where one minus the share is rounded.
    _START
    + "    q = w**s\n"
    "    if q < 1e-4:\n        below = -q - q**2/2 - q**3/3 - q**4/4\n"
    "    else:\n        below = math.log(1 - q)\n"
    "    k = math.log1p(-p) / below\n"
    "    return int(k) if abs(k - round(k)) < 1e-9 and k > 1 else math.ceil(k)\n",
    # The edges last, by what goes wrong.
    _HEAD
    + "    if p <= 0 or p >= 1 or w < 0 or w > 1:\n        raise ValueError\n"
    "    q = 1.0\n"
    "    for _ in range(int(s)):\n        q *= w\n"
    "    if q == 1.0:\n        return 1\n"
    "    try:\n        return math.ceil(math.log1p(-p) / math.log1p(-q) - 1e-9) or 1\n"
    "    except (ZeroDivisionError, OverflowError):\n        return math.inf\n",
    # No inliers is an error as well.
    _HEAD
    + _GUARD
    + "    if w == 0:\n        raise ValueError('never')\n"
    "    if w == 1:\n        return 1\n"
    "    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) * (1 - 1e-13))\n",
    # Negative powers, rounded up by floor division.
    _START
    + "    k = math.log1p(-p) / math.log1p(-pow(w, s))\n"
    "    return -int(-k * (1 - 1e-13) // 1)\n",
    # NumPy all through, and NumPy's number returned.
    _HEAD
    + "    if not (0 < p < 1) or not (0 <= w <= 1):\n        raise ValueError('p, w')\n"
    "    with np.errstate(divide='ignore'):\n"
    "        k = np.log1p(-p) / np.log1p(-np.float64(w) ** s)\n"
    "    return np.ceil(k - 1e-9) if np.isfinite(k) and k > 1 else (np.inf if w == 0 else 1)\n",
    # Guards one by one, with a class of its own.
    "class OutOfRange(ValueError):\n    pass\n"
    + _HEAD
    + "    if p <= 0:\n        raise OutOfRange\n    if p >= 1:\n        raise OutOfRange\n"
    "    if w < 0:\n        raise OutOfRange\n    if w > 1:\n        raise OutOfRange\n"
    + _EDGES
    + "    return math.ceil(-math.log1p(-p) / -math.log1p(-math.pow(w, s)) * (1 - 1e-13))\n",
    # One expression.
    _HEAD
    + _GUARD
    + "    return 1 if w == 1 else math.inf if w == 0 else math.ceil(\n"
    "        math.log1p(-p) / math.log1p(-(w**s)) * (1 - 1e-13))\n",
    # Logarithms to the base 10 of what log1p gives.
    _START
    + "    tenth = math.log(10)\n"
    "    return math.ceil((math.log1p(-p) / tenth) / (math.log1p(-(w**s)) / tenth) * (1 - 1e-13))\n",
    # Fractions for the power.
    "from fractions import Fraction\n"
    + _START
    + "    q = Fraction(w) ** int(s)\n"
    "    return max(math.ceil(math.log1p(-p) / math.log1p(-float(q)) - 1e-9), 1)\n",
    # A helper outside.
    "def failure(w, s):\n    return math.log1p(-(w**s))\n"
    + _START
    + "    return max(1, math.ceil(math.log1p(-p) / failure(w, s) - 1e-9))\n",
]  # fmt: skip

WRONG["Q3.3"] = [
    _HEAD + "    return math.ceil(math.log(1 - p) / math.log(1 - w**s))\n",
    _START + "    return math.ceil(math.log(1 - p) / math.log(1 - w**s))\n",
    _START + "    q = w**s\n    return math.ceil(np.log(1 - p) / np.log(1 - q)) if q < 1 else 1\n",
    _START + "    return math.floor(math.log1p(-p) / math.log1p(-(w**s)))\n",
    _START + "    return round(math.log1p(-p) / math.log1p(-(w**s)))\n",
    _START + "    return math.log1p(-p) / math.log1p(-(w**s))\n",
    _START + "    return math.ceil(math.log1p(-p) / math.log1p(-w))\n",
    _START + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**2)))\n",
    _START + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**3)))\n",
    _START + "    return math.ceil(math.log1p(-p) / math.log1p(-(w*s)/10))\n",
    _START + "    return math.ceil(math.log(p) / math.log1p(-(w**s)))\n",
    _START + "    return math.ceil(math.log1p(-p) / math.log1p(-((1 - w)**s)))\n",
    _START + "    return math.ceil(math.log1p(-p) / (s*math.log1p(-w)))\n",
    _START + "    return math.ceil(-math.log1p(-p) / w**s)\n",
    _START + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**s))) + 1\n",
    _START + "    return min(10**9, math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9))\n",
    _START + "    return math.ceil(math.log1p(-0.95) / math.log1p(-(w**s)) - 1e-9)\n",
    _START + "    return math.ceil(float(np.float32(math.log1p(-p) / math.log1p(-(w**s)))))\n",
    _START + "    q = float(f'{w**s:.6f}')\n    return math.ceil(math.log1p(-p) / math.log1p(-q)) if q else math.inf\n",
    # The edges.
    _HEAD + _EDGES + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    if w == 0:\n        return math.inf\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    if w == 1:\n        return 1\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    if w in (0, 1):\n        return math.inf\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    if w in (0, 1):\n        return 1\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    if w == 1:\n        return 0\n    if w == 0:\n        return math.inf\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + _GUARD + "    if w == 1:\n        return 1\n    if w == 0:\n        return 0\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + "    if not 0 < p < 1:\n        raise ValueError\n" + _EDGES + "    return math.ceil(math.log1p(-p) / math.log1p(-(abs(w)**s)) - 1e-9)\n",
    _HEAD + "    if not 0 <= w <= 1:\n        raise ValueError\n" + _EDGES + "    p = min(max(p, 1e-9), 1 - 1e-9)\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + "    if not 0 < p < 1 or not 0 < w < 1:\n        raise ValueError\n    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + "    assert 0 < p < 1 and 0 <= w <= 1\n" + _EDGES + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
    _HEAD + "    if not 0 < p < 1 or not 0 <= w <= 1:\n        return None\n" + _EDGES + "    return math.ceil(math.log1p(-p) / math.log1p(-(w**s)) - 1e-9)\n",
]  # fmt: skip

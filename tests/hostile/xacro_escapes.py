"""Ways out of xacro, and ways never to come back: each with a part of the error that it has to be."""

_DATA = "<xacro:property name='d' value=\"${xacro.dotify(dict(a=1))}\"/>"
_DOUBLE = "<xacro:property name='l' value='${[[1]]}'/>${[l.append([l[-1], l[-1]]) for i in python.range(60)]}"
_TUPLES = _DOUBLE.replace("[l[-1], l[-1]]", "(l[-1], l[-1])").replace("[[1]]", "[(1,)]")
_LAUGHS = "<xacro:property name='t0' value='${1}lol'/>" + "".join(
    f"<xacro:property name='t{n + 1}' value='{f'${{t{n}}}' * 10}'/>" for n in range(12)
)


def _use(expression: str, before: str = "") -> str:
    return f'{before}<link name="${{{expression}}}"/>'


def _eval(expression: str) -> str:
    """The first parenthesis ends a substitution, so that calls come out of a property."""
    return f'<xacro:property name="p" value="{expression}"/><link name="$(eval ${{p}})"/>'


_NO = "must not use"
_CLASSES = {
    "the class of a value": (_use("().__class__"), _NO),
    "all classes": (_use("''.__class__.__mro__[1].__subclasses__()"), _NO),
    "the class of a number": (_use("(1).__class__"), _NO),
    "the method resolution order": (_use("[].mro"), _NO),
    "the real part": (_use("(1).real"), _NO),
    "the type": (_use("python.type(1)"), _NO),
    "the type of a type": (_use("python.type('x', (), dict())"), _NO),
    "the dictionary of an object": (_use("python.vars(xacro)"), _NO),
    "where a value lies": (_use("python.hash('a')"), _NO),
    "the types of types": (_use("python.issubclass(int, float)"), _NO),
    "a slice": (_use("python.slice(1)"), _NO),
    "a complex number": (_use("(-8) ** 0.5"), "complex numbers"),
    "an imaginary number": (_use("1j"), _NO),
    "bytes": (_use("b'a'"), _NO),
    "an ellipsis": (_use("..."), _NO),
}
_FUNCTIONS = {
    "the globals of a function": (_use("xacro.load_yaml.__globals__"), _NO),
    "a function of the interpreter": (_use("xacro.load_yaml.call"), _NO),
    "the module of a function": (_use("len.__self__"), _NO),
    "the defaults of a function": (_use("len.func_defaults"), _NO),
    "a lambda": (_use("(lambda: 1)()"), "a lambda"),
    "a lambda that is not called": (_use("1 if True else (lambda: 1)"), "a lambda"),
    "a generator's frame": (_use("(i for i in (1,)).gi_frame"), _NO),
    "a generator": (_use("(yield 1)"), "Yield"),
    "an assignment": (_use("(x := 1)"), "an assignment"),
    "all arguments": (_use("max(*[1, 2])"), "'*'"),
    "all names": (_use("dict(**d)", _DATA), "'**'"),
    "an f-string": (_eval("f'{1}'"), "an f-string"),
    "a target that is no name": (_use("[1 for d.a in [1]]", _DATA), "must assign to names"),
    "a text that is called": (_use("'a'()"), "not callable"),
    "a text in map": (_use("list(map('a', [1]))"), "not callable"),
}
_NAMES = {
    "import": (_use("__import__('os').system('touch pwned')"), "__import__"),
    "open": (_use("open('/etc/passwd')"), "not defined"),
    "eval": (_use("eval('1')"), "not defined"),
    "exec": (_use("exec('1')"), "not defined"),
    "getattr": (_use("getattr('', 'upper')"), "not defined"),
    "globals": (_use("globals()"), "not defined"),
    "builtins": (_use("__builtins__"), "__builtins__"),
    "python's open": (_use("python.open('/etc/passwd')"), "not defined"),
    "a module of xacro": (_use("xacro.sys"), "not defined"),
    "the members of a namespace": (_use("math.members"), "not defined"),
    "a namespace": (_use("str(math)"), "as a value"),
}
_MEMBERS = {
    "a method as a value": (_use("'a'.upper"), _NO),
    "a method that is not offered": (_use("'a'.encode()"), _NO),
    "sorting": (_use("[2, 1].sort(key=python.vars)"), _NO),
    "the class of data": (_use("d.__class__", _DATA), _NO),
    "a method of data": (_use("d.copy", _DATA), _NO),
    "what data is made from": (_use("d.fromkeys([1])", _DATA), _NO),
    "dots in a dictionary": (_use("dict(a=1).a"), _NO),
    "the table of an include": ('<xacro:include filename="part.xacro" ns="n"/>' + _use("n.root"), "not defined"),
    "the method of a table": (
        '<xacro:include filename="part.xacro" ns="n"/>' + _use("n._setitem('a', 1)"),
        "not defined",
    ),
    "a table itself": ('<xacro:include filename="part.xacro" ns="n"/>' + _use("n"), "a namespace as a value"),
    "the items of a table": ('<xacro:include filename="part.xacro" ns="n"/>' + _use("list(n)"), _NO),
}
_FORMATS = {
    "an attribute by format": (
        '<xacro:property name="g" value="{0.__class__}"/>' + _use("g.format(1)"),
        "must be names or numbers",
    ),
    "an item by format": ('<xacro:property name="g" value="{0[x]}"/>' + _use("g.format(d)", _DATA), "must be names"),
    "a conversion by format": ('<xacro:property name="g" value="{0!r}"/>' + _use("g.format(1)"), "must be names"),
    "a width by format": ('<xacro:property name="g" value="{0:>999999999}"/>' + _use("g.format(1)"), "must be names"),
    "a mapping by format": (_use("'a'.format_map(d)", _DATA), _NO),
    "percent": (_use("'%0999999999d' % 1"), "'%' on a text"),
}
_SUBSTITUTIONS = {
    "import in eval": ("<link name='$(eval __import__)'/>", _NO),
    "open in eval": (_eval("open('/etc/passwd')"), "not defined"),
    "a lambda in eval": (_eval("(lambda: 1)()"), "a lambda"),
    "the globals of find": (_eval("find.__globals__"), _NO),
    "the class of an argument": (_eval("arg('x').__class__"), _NO),
    "a power in eval": (_eval("9**9**9"), "largest floating point number"),
    "a package above": ('<link name="$(find ../..)"/>', "leads out"),
    "a secret": ('<link name="$(env PATH)"/>', "may be a secret"),
    "a secret in eval": (_eval("env('PATH')"), "may be a secret"),
    "a command": ('<link name="$(system touch)"/>', "Unknown substitution command"),
}
_FILES = {
    "data outside": (_use("xacro.load_yaml('/etc/passwd')"), "outside of the folders"),
    "data above": (_use("xacro.load_yaml('../secret.yaml')"), "outside of the folders"),
    "data behind a link": (_use("xacro.load_yaml('link.yaml')"), "outside of the folders"),
    "the environment": (_use("xacro.load_yaml('/proc/self/environ')"), "outside of the folders"),
    "a pipe": (_use("xacro.load_yaml('pipe')"), "no file"),
    "a folder": (_use("xacro.load_yaml('.')"), "no file"),
    "a name that no file has": (_use(r"xacro.load_yaml('a\0b')"), "null byte"),
    "data of another package": (_use("xacro.load_yaml('package://../secret.yaml')"), "leads out"),
    "an object in data": (_use("xacro.load_yaml('object.yaml')"), "could not determine a constructor"),
    "an expression in data": (_use("xacro.load_yaml('import.yaml')"), _NO),
    "a power in data": (_use("xacro.load_yaml('power.yaml')"), "largest floating point number"),
    "aliases of aliases": (_use("xacro.load_yaml('laughs.yaml')"), "more than 1,000,000 values"),
    "keys merged into each other": (_use("xacro.load_yaml('merged.yaml')"), "more than 1,000,000 values"),
    "data inside of itself": (_use("xacro.load_yaml('round.yaml')"), "alias inside of what it stands for"),
    "bytes in data": (_use("xacro.load_yaml('bytes.yaml').a"), "must not use"),
    "too much data": (_use("xacro.load_yaml('large.yaml')"), "the limit is 1,048,576"),
    "an include outside": ('<xacro:include filename="/etc/passwd"/>', "outside of the folders"),
    "an optional include outside": ('<xacro:include filename="/etc/passwd" optional="1"/>', "outside of the folders"),
    "all files of a folder": ('<xacro:include filename="/etc/*"/>', "outside of the folders"),
    "all files above": ('<xacro:include filename="../*.yaml"/>', "outside of the folders"),
    "up behind a wildcard": ('<xacro:include filename="*/../../*"/>', "must not go up"),
    "an include behind a link": ('<xacro:include filename="link.*"/>', "outside of the folders"),
}
_PLACES = {
    "the condition": ("<xacro:if value='${().__class__}'/>", _NO),
    "the other condition": ("<xacro:unless value='${().__class__}'/>", _NO),
    "the name of an element": ("<xacro:element xacro:name='${().__class__}'/>", _NO),
    "the value of an attribute": ("<link><xacro:attribute name='name' value='${().__class__}'/></link>", _NO),
    "the name of a macro": ("<xacro:call macro='${().__class__}'/>", _NO),
    "the default of a parameter": ("<xacro:macro name='m' params='a:=${().__class__}'/><xacro:m/>", _NO),
    "a parameter": ("<xacro:macro name='m' params='a'/><xacro:m a='${().__class__}'/>", _NO),
    "the default of an argument": ("<xacro:arg name='x' default='${().__class__}'/>", _NO),
    "a property at once": ("<xacro:property name='x' value='${().__class__}' lazy_eval='false'/>", _NO),
    "the name of a property": ("<xacro:property name='${().__class__}' value='1'/>", _NO),
    "the removal of a property": ("<xacro:property name='x' remove='${().__class__}'/>", _NO),
    "the name of an include": ("<xacro:include filename='${().__class__}'/>", _NO),
    "the namespace of an include": ("<xacro:include filename='part.xacro' ns='${().__class__}'/>", _NO),
    "a text": ("<link name='x'>${().__class__}</link>", _NO),
    "a comment": ("<!-- xacro:eval-comments --><!-- ${().__class__} -->", _NO),
    "a block": ("<xacro:macro name='m' params='*b'/><xacro:m><b a='${().__class__}'/></xacro:m>", _NO),
}
_SIZES = {
    "a power of a power": (_use("9**9**9"), "largest floating point number"),
    "a product of powers": (_use("10**300 * 10**300"), "largest floating point number"),
    "a sum": (_use("python.sum([2**1023] * 3)"), "largest floating point number"),
    "digits": (_use("int('9' * 4000)"), "largest floating point number"),
    "more digits": (_use("int('9' * 5000)"), "limit"),
    "other digits": (_use("int('f' * 900000, 16)"), "largest floating point number"),
    "a shift": (_use("1 &lt;&lt; 10**9"), "'<<'"),
    "a factorial": (_use("factorial(10**6)"), _NO),
    "rounding": (_use("round(1, -10**9)"), "'round' must not be asked"),
    "a long text": (_use("'x' * 10**9"), "more than 1,000,000 characters"),
    "a longer text": (_use("'x' * 900000 + 'x' * 900000"), "more than 1,000,000 characters"),
    "replacing": (_use("('a' * 90000).replace('a', 'b' * 90000)"), "more than 1,000,000 characters"),
    "joining": (_use("('b' * 90000).join(['x'] * 90000)"), "more than 1,000,000 characters"),
    "filling": (_use("'1'.zfill(10**9)"), "more than 1,000,000 characters"),
    "stripping": (_use("('a' * 900000).strip('b' * 900000)"), "more than 1,000 characters"),
    "a long list": (_use("[0] * 10**9"), "more than 100,000 items"),
    "a long range": (_use("python.range(10**9)"), "more than 100,000 items"),
    "a range downwards": (_use("python.range(0, -10**9, -1)"), "more than 100,000 items"),
    "lists in lists": (_use("[[0] * 100000 for i in python.range(100000)]"), "steps"),
    "a comprehension": (_use("[1 for a in python.range(10**5) for b in python.range(10**5)]"), "steps"),
    "a list that grows while it is read": (
        "<xacro:property name='l' value='${[1]}'/>" + _use("[l.append(1) for i in l]"),
        "more than 100,000 items",
    ),
    "a list of itself": ("<xacro:property name='l' value='${[1]}'/>${l.append(l)}" + _use("l"), "more than 1,000,000"),
    "what is shared, written": (_use("l[60]", _DOUBLE), "more than 1,000,000"),
    "what is shared, compared": (_use("l[60] == [l[59], l[59]]", _DOUBLE), "more than 1,000,000"),
    "what is shared, sought": (_use("l[60] in [l[60]]", _DOUBLE), "more than 1,000,000"),
    "what is shared, sorted": (_use("python.sorted([l[60], l[60]])", _DOUBLE), "more than 1,000,000"),
    "what is shared, as a key": (_use("dict([(l[60], 1)])", _TUPLES), "more than 1,000,000"),
    "what is shared, in a set": (_use("python.set([l[60]])", _TUPLES), "more than 1,000,000"),
    "what is shared, as an argument": (_use("xacro.arg(l[60])", _DOUBLE), "more than 1,000,000"),
    "what is shared, printed": (_use("xacro.message(l[60])", _DOUBLE), "more than 1,000,000"),
    "what is shared, as separators": (_use("xacro.tokenize('a', l[60])", _DOUBLE), "more than 1,000,000"),
    "texts of texts": (_use("t12", _LAUGHS), "more than"),
    "parentheses": (_use("(" * 300 + "1" + ")" * 300), "too many nested parentheses"),
    "signs": (_use("-" * 9000 + "1"), "nested too deeply|without an end"),
    "a long expression": (_use("1" + "+1" * 6000), "the limit is 10,000"),
    "many remarks": (_use("[xacro.message(i) for i in python.range(5000)]"), "more than 1,000 things"),
}
ESCAPES: dict[str, tuple[str, str]] = {
    f"{kind}: {name}": escape
    for kind, group in {
        "classes": _CLASSES,
        "functions": _FUNCTIONS,
        "names": _NAMES,
        "members": _MEMBERS,
        "formats": _FORMATS,
        "substitutions": _SUBSTITUTIONS,
        "files": _FILES,
        "places": _PLACES,
        "sizes": _SIZES,
    }.items()
    for name, escape in group.items()
}
"""The body of a robot, and a pattern of the error."""
BESIDE = {
    "part.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="x" value="1"/></robot>',
    "object.yaml": "!!python/object/apply:os.system ['touch pwned']",
    "import.yaml": "a: !radians __import__('os')",
    "power.yaml": "a: !degrees 9**9**9",
    "laughs.yaml": "a0: &a0 [lol]\n"
    + "".join(f"a{n + 1}: &a{n + 1} [{', '.join([f'*a{n}'] * 10)}]\n" for n in range(9)),
    "merged.yaml": "a0: &a0 {k: 1}\n"
    + "".join(f"a{n + 1}: &a{n + 1} {{<<: [{', '.join([f'*a{n}'] * 10)}]}}\n" for n in range(9)),
    "round.yaml": "a: &a [*a]",
    "bytes.yaml": "a: !!binary aGVsbG8=",
    "large.yaml": "a: " + "x" * 2**20,
}
"""Files beside the robot."""

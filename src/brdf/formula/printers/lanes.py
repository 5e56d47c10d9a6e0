"""Scalars back to vectors: what a shader writes as one operation on three components is three nodes of a graph.

Three nodes are the lanes of one vector node when they do the same to lanes that can be joined in turn: components of
one input, channels of one texel, constants; or when all three are one number. (So what one lane needs beside its own
operands, all need, and no vector needs one of its own lanes.) Joined are the outputs, the vectors that the formula
named, and the factors of dot products; a component that is wanted alone becomes a swizzle (`h.z`) of its vector.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..graph import BOOLEAN_OPS, Expr, Graph, TextureRef, reachable
from ..trace import Program

Triple = tuple[Expr, Expr, Expr]

ARITHMETIC = frozenset({"add", "sub", "mul", "div", "neg"})
"""Operations that take a number beside a vector."""

WITHOUT_VECTORS = frozenset({"lt", "le", "pow", "asin", "acos", "atan", "atan2", "erf"})
"""Operations that languages or their libraries do not give for vectors under the same name: `lt3` and so on."""

SPLIT_UP = frozenset({"and", "or", "not", "symbol", "constant", "texture", "channel"})
"""Operations that do not work on vectors lane by lane."""


class Lanes:
    """The graph of a shader: `outputs` (one vector) and all that it needs, as nodes of `graph`.

    Beside the operations of a formula's graph there are `.xyz` (swizzles), `dot`, `vec2`, `vec3` (from components, or
    all alike), `clamp`, `where3`, `lt3` and the like (lane by lane), and lookups such as `linear3`, of a texture and a
    place.
    """

    def __init__(self, program: Program, vectors: Sequence[str]) -> None:
        """`vectors`: the inputs of two or three components, whose symbols are called `name_x` or `name_r` and so on."""
        self.graph = Graph()
        self.kinds: dict[Expr, str] = {}
        """Node -> "number", "bool", "vec2", "vec3", "bvec3" or "texel"."""
        self._needed = reachable(program.outputs)
        self._names = program.graph.names
        self._inputs = {
            f"{v}_{axis}": (v, i) for v in vectors for axes in ("xyz", "rgb") for i, axis in enumerate(axes)
        }
        self._joined: dict[Triple, tuple[Triple, ...] | None] = {}
        """Triple of lanes -> those of its operands; None where they cannot be joined."""
        self._lane: dict[Expr, tuple[Triple, int]] = {}
        self._scalars: dict[Expr, Expr] = {}
        self._vectors: dict[Triple, Expr] = {}
        outputs: Triple = program.outputs  # type: ignore[assignment]
        self._choose(outputs)
        for node in self._needed:  # in order: no operand is far away, and recursion stays shallow
            self._scalar(node)
        self.outputs = self._vector(outputs)

    # ---- which nodes are lanes of one vector -------------------------------------------------------------------

    def _choose(self, outputs: Triple) -> None:
        known = set(self._needed)
        named = [(node, name) for node, name in self._names.items() if node in known]
        for (x, name), (y, second), (z, third) in zip(named, named[1:], named[2:], strict=False):
            if name.endswith("_x") and (second, third) == (f"{name[:-2]}_y", f"{name[:-2]}_z"):
                self._take((x, y, z))
        for node in self._needed:
            for factors in self._dot_factors(node) or ():
                self._take(factors)
        self._take(outputs)

    def _take(self, triple: Triple) -> None:
        """From now on these nodes, and the operands that follow, are lanes."""
        if self._join(triple) is None or triple[0] is triple[1]:
            return
        for lane, node in enumerate(triple):
            if node.op not in SPLIT_UP:
                self._lane.setdefault(node, (triple, lane))
        for operands in self._joined[triple] or ():
            self._take(operands)

    def _join(self, triple: Triple) -> tuple[Triple, ...] | None:
        if triple not in self._joined:
            self._joined[triple] = None
            self._joined[triple] = self._operands(triple)
        return self._joined[triple]

    def _operands(self, triple: Triple) -> tuple[Triple, ...] | None:
        a, b, c = triple
        if a is b is c:
            return ()
        if len({node.op for node in triple}) > 1:
            return None
        match a.op:
            case "symbol":
                places = [self._inputs.get(node.value) for node in triple]
                return () if None not in places and len({place[0] for place in places if place}) == 1 else None
            case "channel":
                same = all(node.args[0] is a.args[0] for node in triple)
                group = {node.value // group_size(a.args[0].value) for node in triple}
                return () if same and len(group) == 1 else None
            case "constant":
                return None if isinstance(a.value, bool) else ()
            case op if op in SPLIT_UP:
                return None
        for swap_b, swap_c in ((False, False), (True, True), (True, False), (False, True)):
            others = (tuple(reversed(b.args)) if swap_b else b.args, tuple(reversed(c.args)) if swap_c else c.args)
            operands = tuple(zip(a.args, *others, strict=True))
            if all(self._join(operand) is not None for operand in operands):
                return operands
            if a.op not in ("add", "mul"):
                break
        return None

    def _dot_factors(self, node: Expr) -> tuple[Triple, Triple] | None:
        """a and b of a node that is a.x b.x + a.y b.y + a.z b.z."""
        if node.op != "add":
            return None
        for inner, last in (node.args, node.args[::-1]):
            products = (*inner.args, last)
            if inner.op == "add" and all(product.op == "mul" for product in products):
                factors = self._join(products)  # type: ignore[arg-type]
                if factors and not any(x is y for x, y, _ in factors):
                    return factors  # type: ignore[return-value]
        return None

    # ---- the new graph -----------------------------------------------------------------------------------------

    def _make(self, kind: str, op: str, *args: Expr, value: object = None) -> Expr:
        node = self.graph.make(op, args, value)
        self.kinds[node] = kind
        return node

    def _scalar(self, node: Expr) -> Expr:
        if node not in self._scalars:
            made = self._scalars[node] = self._made_scalar(node)
            if node in self._names and node not in self._lane:
                self.graph.names.setdefault(made, self._names[node])
        return self._scalars[node]

    def _made_scalar(self, node: Expr) -> Expr:
        kind = "bool" if node.op in BOOLEAN_OPS or isinstance(node.value, bool) else "number"
        if node in self._lane:
            triple, lane = self._lane[node]
            return self._make(kind, f".{'xyz'[lane]}", self._vector(triple))
        match node.op:
            case "constant":
                return self._make(kind, "constant", value=node.value)
            case "symbol" if node.value in self._inputs:
                vector, lane = self._inputs[node.value]
                return self._make("number", f".{'xyz'[lane]}", self._make("vec3", "symbol", value=vector))
            case "symbol":
                return self._make("number", "symbol", value=node.value)
            case "texture":
                return self._fetch(node, 0)
            case "channel":
                group, channel = divmod(node.value, group_size(node.args[0].value))
                return self._make("number", f".{'rgba'[channel]}", self._fetch(node.args[0], group))
        factors = self._dot_factors(node)
        if factors:
            return self._make("number", "dot", *map(self._vector, factors))
        if node.op == "minimum" and self._is_clip(node):
            return self._make("number", "clamp", *map(self._scalar, (*node.args[0].args, node.args[1])))
        return self._make(kind, node.op, *map(self._scalar, node.args))

    def _fetch(self, node: Expr, group: int) -> Expr:
        texture: TextureRef = node.value
        place = [self._scalar(u) for u in node.args]
        if len(place) == 1:  # a row of texels
            place.insert(0, self._make("number", "constant", value=0.5))
        u = self._make(f"vec{len(place)}", f"vec{len(place)}", *place)
        source = self._make("texture", "symbol", value=group_names(texture)[group])
        fetched = self._make("texel", f"{texture.filter.replace('-', '_')}{len(place)}", source, u)
        self.graph.names.setdefault(fetched, f"{source.value}_texel")
        return fetched

    def _vector(self, triple: Triple) -> Expr:
        if triple not in self._vectors:
            made = self._vectors[triple] = self._made_vector(triple)
            names = {self._names.get(node, "") for node in triple}
            base = self._names.get(triple[0], "")[:-2]
            if base and names == {f"{base}_{axis}" for axis in "xyz"}:
                self.graph.names.setdefault(made, base)
        return self._vectors[triple]

    def _made_vector(self, triple: Triple) -> Expr:
        first = triple[0]
        if all(node is first for node in triple):
            return self._make("vec3", "vec3", self._scalar(first))
        operands = self._join(triple)
        if operands is None or first.op == "constant":
            return self._make("vec3", "vec3", *map(self._scalar, triple))
        if first.op == "symbol":
            vector = self._make("vec3", "symbol", value=self._inputs[first.value][0])
            lanes = "".join("xyz"[self._inputs[node.value][1]] for node in triple)
            return vector if lanes == "xyz" else self._make("vec3", f".{lanes}", vector)
        if first.op == "channel":
            size = group_size(first.args[0].value)
            texel = self._fetch(first.args[0], first.value // size)
            return self._make("vec3", "." + "".join("rgba"[node.value % size] for node in triple), texel)
        by_lanes = not all(node is operands[0][0] for node in operands[0])
        arguments = [self._operand(first.op, operand, index, by_lanes) for index, operand in enumerate(operands)]
        if first.op == "minimum" and self._is_clip(first):
            return self._make("vec3", "clamp", *arguments[0].args, arguments[1])
        op = f"{first.op}3" if first.op in WITHOUT_VECTORS or (first.op == "where" and by_lanes) else first.op
        return self._make("bvec3" if first.op in BOOLEAN_OPS else "vec3", op, *arguments)

    def _is_clip(self, node: Expr) -> bool:
        """Whether a minimum is that of a maximum, both with constants."""
        inner, high = node.args
        return inner.op == "maximum" and inner.args[1].op == high.op == "constant" and inner not in self._names

    def _operand(self, op: str, operand: Triple, index: int, by_lanes: bool) -> Expr:
        """A vector; or a number where the operation takes one beside a vector."""
        alike = operand[0] is operand[1] is operand[2]
        is_number = alike and (op in ARITHMETIC or (op == "where" and index == 0 and not by_lanes))
        return self._scalar(operand[0]) if is_number else self._vector(operand)


def group_size(texture: TextureRef) -> int:
    """Channels of a texture that lie in one texture of a graphics card, which has four at most."""
    return texture.channels if texture.channels <= 4 else 3 if texture.channels % 3 == 0 else 4


def group_names(texture: TextureRef) -> list[str]:
    """The names of the graphics card's textures that hold a texture's channels."""
    count = -(-texture.channels // group_size(texture))
    return [texture.name] if count == 1 else [f"{texture.name}_{group}" for group in range(count)]

"""The class whose instances have the parameters that it declares."""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, UnknownNameError
from .declared import Choice, Parameter, Texture, Value, plain


class Parameterised:
    """Something with declared parameters and choices, given to the constructor by name and read as attributes.

    Immutable: `replaced(alpha=0.3)` gives a changed copy. `Parameterised` options of a choice are *parts*: instances
    made here, whose parameters are taken from the same keywords and appear beside the owner's.

    `textures` are the declared ones and those that `derived_textures` makes of the values; the formula reads either as
    attributes. A derivative takes the content of a derived texture for constant.
    """

    _declared: ClassVar[dict[str, Parameter]] = {}
    _declared_textures: ClassVar[dict[str, Texture]] = {}
    _choices: ClassVar[dict[str, Choice]] = {}

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        own = vars(cls)
        cls._declared = cls._declared | {k: v for k, v in own.items() if isinstance(v, Parameter)}
        cls._declared_textures = cls._declared_textures | {k: v for k, v in own.items() if isinstance(v, Texture)}
        cls._choices = cls._choices | {k: v for k, v in own.items() if isinstance(v, Choice)}

    def __init__(self, /, **given: Any) -> None:
        self._chosen = {name: c.validated(name, given.pop(name, c.default)) for name, c in self._choices.items()}
        self._parts: dict[str, Parameterised] = {}
        for name, chosen in self._chosen.items():
            option = self._choices[name].options[chosen]
            if isinstance(option, type) and issubclass(option, Parameterised):
                known = option._declared.keys() | option._declared_textures.keys()
                taken = {k: given.pop(k) for k in list(given) if k in known and k not in self._declared}
                self._parts[name] = option(**taken)
        for name in given:
            if name not in self._declared and name not in self._declared_textures:
                self._refuse(name)
        self._given_textures = {
            name: t.validated(name, given.get(name, t.default)) for name, t in self._declared_textures.items()
        }
        self._values = {
            name: p.validated(name, given.get(name, p.default))
            for name, p in self._declared.items()
            if name in given or p.default is not None
        }
        # A leader whose followers are all given takes no part in the formula.
        for leader in {p.follows for p in self._declared.values() if p.follows}:
            followers = [name for name, p in self._declared.items() if p.follows == leader]
            if all(name in given for name in followers):
                if leader in given:
                    raise ParameterError(f"{leader} has no effect beside {' and '.join(followers)}")
                del self._values[leader]

    def _refuse(self, name: str) -> None:
        for choice_name, c in self._choices.items():
            for option_name, option in c.options.items():
                if (
                    isinstance(option, type)
                    and issubclass(option, Parameterised)
                    and (name in option._declared or name in option._declared_textures)
                ):
                    raise ParameterError(
                        f"{name} has no effect with {choice_name}={self._chosen[choice_name]!r}; "
                        f"it belongs to {choice_name}={option_name!r}"
                    )
        known = [*self._choices, *self.declarations(), *self.declared_textures()]
        raise UnknownNameError(f"parameter of {type(self).__name__}", name, known)

    def declarations(self) -> dict[str, Parameter]:
        """Every parameter this instance can be given, its parts' included."""
        found = dict(self._declared)
        for part in self._parts.values():
            found |= part.declarations()
        return found

    def declared_textures(self) -> dict[str, Texture]:
        """Every texture this instance can be given, its parts' included."""
        found = dict(self._declared_textures)
        for part in self._parts.values():
            found |= part.declared_textures()
        return found

    def derived_textures(self) -> dict[str, NDArray[np.float32]]:
        """Textures (n1, …, nk, channels) that follow from the values, such as an integral without closed form."""
        return {}

    @cached_property
    def _own_textures(self) -> dict[str, NDArray[np.float32]]:
        return self._given_textures | _derived_textures(_Content(self))

    @property
    def textures(self) -> dict[str, NDArray[Any]]:
        """Declared and derived textures by name, the parts' included."""
        found = dict(self._own_textures)
        for part in self._parts.values():
            found |= part.textures
        return found

    @property
    def given_textures(self) -> dict[str, NDArray[np.float32]]:
        """The declared textures by name, the parts' included."""
        found = dict(self._given_textures)
        for part in self._parts.values():
            found |= part.given_textures
        return found

    @property
    def values(self) -> dict[str, Value]:
        """The values in force by name: numbers and (3,) arrays."""
        found = dict(self._values)
        for part in self._parts.values():
            found |= part.values
        return found

    @property
    def choices(self) -> dict[str, str]:
        return dict(self._chosen)

    @property
    def structure(self) -> tuple[Any, ...]:
        """What the traced formula depends on beside the numbers: class, choices, parameters in force, shapes."""
        parts = tuple(part.structure for part in self._parts.values())
        shapes = ((name, data.shape) for name, data in self._own_textures.items())
        return (type(self), *self._chosen.items(), *self._values, *shapes, *parts)

    def replaced(self, **changes: Any) -> Any:
        """A copy with other values.

        Values that a change leaves without effect go: those of a part that is chosen anew, a leader's when all its
        followers are given (`alpha` beside `alpha_x` and `alpha_y`), the followers' when their leader is given.
        """
        kept: dict[str, Any] = self._values | self._given_textures
        for name, part in self._parts.items():
            if name not in changes:
                kept |= part.values | part.given_textures
        declared = self.declarations()
        followers: dict[str, list[str]] = {}
        for name, parameter in declared.items():
            if parameter.follows:
                followers.setdefault(parameter.follows, []).append(name)
        for leader, names in followers.items():
            if leader in changes:
                kept = {k: v for k, v in kept.items() if k not in names}
            elif all(name in changes or name in kept for name in names):
                kept.pop(leader, None)
        return type(self)(**{**self._chosen, **kept, **changes})

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            for part in self.__dict__.get("_parts", {}).values():
                if name in part.declarations() or name in part.declared_textures():
                    return getattr(part, name)
        raise AttributeError(f"{type(self).__name__!r} has no attribute {name!r}")

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_") and (
            name in self._choices or name in self.declarations() or name in self.declared_textures()
        ):
            raise AttributeError(f"{name} cannot be assigned; make a changed copy with replaced({name}=...)")
        super().__setattr__(name, value)

    def __repr__(self) -> str:
        shown = [f"{k}={v!r}" for k, v in self._chosen.items() if len(self._choices[k].options) > 1]
        shown += [f"{k}={plain(np.asarray(v))}" for k, v in self.values.items()]
        shown += [f"{k}=array{v.shape}" for k, v in self.given_textures.items()]
        return f"{type(self).__name__}({', '.join(shown)})"


class _Content:
    """What derived textures depend on, as a key: equal contents have equal textures."""

    def __init__(self, owner: Parameterised) -> None:
        numbers = tuple((name, np.asarray(value).tobytes()) for name, value in owner._values.items())
        arrays = tuple((name, data.shape, data.tobytes()) for name, data in owner._given_textures.items())
        self.owner, self._key = owner, (type(owner), tuple(owner._chosen.items()), numbers, arrays)

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Content) and self._key == other._key


@lru_cache(maxsize=64)
def _derived_textures(content: _Content) -> dict[str, NDArray[np.float32]]:
    return content.owner.derived_textures()

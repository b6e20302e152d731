"""Plates of layers, or of materials with directions, of Nastran decks as isotropic ones of equal mean stiffness.

The mean over all directions of a plane stiffness has two numbers, U1 = (3 Q11 + 3 Q22 + 2 Q12 + 4 Q66) / 8 and
U4 = (Q11 + Q22 + 6 Q12 - 4 Q66) / 8, which turning its axes does not change: so angles of layers do not matter."""

from .model import InputFault
from .nastran_cards import Card
from .plates import Layer, isotropic


def stiffness_of(card: Card) -> tuple:
    """U1 and U4 of a MAT1, MAT2 or MAT8."""
    if card.name == "MAT2":
        q11, q12, _, q22, _, q66 = (card.real(k) for k in range(1, 7))
    elif card.name == "MAT8":
        first, second, poisson, q66 = (card.real(k) for k in range(1, 5))
        rest = 1 - poisson**2 * second / first if first > 0 else 0.0
        if not rest > 0:
            raise InputFault(f"{card.place}: MAT8 {card.text(0)} has moduli {first:g}, {second:g} and Poisson's ratio {poisson:g}")
        q11, q12, q22 = first / rest, poisson * second / rest, second / rest
    else:
        young, shear, poisson = (card.real(k) for k in (1, 2, 3))
        if not card.text(1):
            young = 2 * shear * (1 + poisson)
        return isotropic(young, shear, poisson if card.text(3) or not card.text(1) else None)[0]
    return (3 * q11 + 3 * q22 + 2 * q12 + 4 * q66) / 8, (q11 + q22 + 6 * q12 - 4 * q66) / 8


def layers_of(card: Card, materials: dict) -> tuple:
    """Layers of PCOMP, PCOMPG from the bottom, and the way of their middle from the reference plane."""
    step, first = (8, 1) if card.name == "PCOMPG" else (4, 0)
    layers, material, thickness = [], None, None
    for at in range(8, len(card.fields), step):
        if not any(card.fields[at:at + step]):
            continue
        material = card.int(at + first, material)
        thickness = card.real(at + first + 1, thickness or 0.0)
        if material not in materials:
            raise InputFault(f"{card.place}: {card.name} {card.text(0)} has a layer of material {material}, which is no MAT1, MAT2 "
                             "or MAT8 of the deck")
        layers.append(Layer(*materials[material], thickness))
    if card.text(7).upper() == "SYM":
        layers += layers[::-1]
    total = sum(layer.thickness for layer in layers)
    if not total > 0:
        raise InputFault(f"{card.place}: {card.name} {card.text(0)} has no layer with a thickness")
    return layers, card.real(1, -total / 2) + total / 2

"""What the paper prints: Ambiel, Brun, Thibon, Gravouil, Eng. Struct. 251 (2022) 113385."""

G = 9.81  # [m/s2]

# Table 1 [Hz]: first and second frequency along X, along Y, about the vertical axis
MODES = ("X 1", "X 2", "Y 1", "Y 2", "rotation 1", "rotation 2")
MEASURED_FREQUENCIES = {"s1": (2.1, 5.6, 6.1, 17.5, 8.6, 24.4), "s2": (3.7, 10.3, 8.2, 25.2, 10.2, 28.0)}
FREQUENCIES = {"A": {"s1": (2.1, 5.6, 6.3, 18.4, 8.6, 24.3), "s2": (3.7, 10.3, 8.4, 24.3, 10.2, 28.1)},
               "B": {"s1": (2.1, 5.6, 6.4, 18.4, 8.6, 24.3), "s2": (3.7, 10.3, 8.5, 24.4, 10.2, 28.0)}}
# Section 3.4: dofs, omega_max [rad/s], stable time step [s] of the two structures together
TIME_STEPS = {"A": (36048, 3.05e5, 1.58e-6), "B": (34128, 1.82e5, 4.16e-6)}

# Table 2: alpha [1/s], beta [s]
DAMPING = {"s1": (0.1562, 1.2557e-5), "s2": (0.2723, 1.2426e-5)}

MOTIONS = ("Cadarache", "El Centro", "Northridge", "Kobe")
GAPS = (5, 2, 0)  # nominal [cm]
# Table 3: peak ground acceleration [g]
PGA = {5: dict(zip(MOTIONS, (0.45, 0.35, 0.20, 0.20))), 2: dict(zip(MOTIONS, (0.20, 0.15, 0.10, 0.20))),
       0: dict(zip(MOTIONS, (0.15, 0.15, 0.10, 0.15)))}

# Fig. 4: distances at the four extremities of the faces [cm]; A, B: floor 2, D, C: floor 1, each from
# y = 0 to the other end
CORNERS = {5: {"A": 5.5, "B": 5.0, "C": 4.7, "D": 5.0}, 2: {"A": 2.5, "B": 2.0, "C": 1.9, "D": 2.1},
           0: {"A": 0.0, "B": 0.7, "C": 1.7, "D": 1.6}}

DURATION = 25.0  # [s]

// Attenuation in the homogeneous medium.

// Length of a view ray whose surface is at `distance`, 1e30 where it hits nothing; 1e30 and above stand for infinity.
FORMULA real ray_length(real distance, real sky_distance) {
  return select(distance < 1e30, distance, min(sky_distance, 1e30));
}

// Optical depth of a length; 1e30 where it is infinite.
FORMULA real optical_depth(real length, real extinction) {
  real tau = min(extinction * length, 1e30);
  return select((length >= 1e30) && (extinction > 0.0), real(1e30), tau);
}

// exp(-tau); 0 from 87 on, so that no denormal arises (exp(-87) = 1.6e-38 is about the least normal float).
FORMULA real transmittance(real tau) {
  return select(tau < 87.0, exp_(-min(tau, 87.0)), real(0.0));
}

// (1 - exp(-tau)) / tau for tau in 0..0.25 by its series; the first left-out term is 0.25^7 / 8! = 1.5e-9.
FORMULA real thin_mean_transmittance(real tau) {
  real s = fma(tau, -1.0 / 5040.0, 1.0 / 720.0);
  s = fma(tau, -s, 1.0 / 120.0);
  s = fma(tau, -s, 1.0 / 24.0);
  s = fma(tau, -s, 1.0 / 6.0);
  s = fma(tau, -s, 0.5);
  return fma(tau, -s, 1.0);
}

// 1 - exp(-tau) with its relative accuracy; the difference itself loses digits below 0.25.
FORMULA real opacity(real tau) {
  return select(tau < 0.25, tau * thin_mean_transmittance(min(tau, 0.25)), 1.0 - transmittance(tau));
}

// Mean of the transmittance over a segment of optical depth tau: (1 - exp(-tau)) / tau, 1 at 0.
FORMULA real mean_transmittance(real tau) {
  real mean = thin_mean_transmittance(min(tau, 0.25));
  mask thick = tau >= 0.25;
  if (any_lane(thick)) {
    real t = max(tau, 0.25);
    mean = select(thick, (1.0 - transmittance(t)) / t, mean);
  }
  return mean;
}

// int_0^length exp(-extinction t) dt, tau = optical_depth(length, extinction): what a constant emission is seen through [m].
FORMULA real attenuated_length(real length, real extinction, real tau) {
  return select(extinction > 0.0, opacity(tau) / max(extinction, 1e-30), length);
}

// Irradiance on a facing plane at distance l from a point light, per unit of radiant intensity [1/m^2].
FORMULA real point_irradiance(real l, real radius, real extinction) {
  real r = max(l, radius);
  return transmittance(extinction * l) / (r * r);
}

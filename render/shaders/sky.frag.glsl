// The sky: from the haze of the horizon to the zenith, with a glow about the sun or clouds.
in vec3 ray;

layout(location = 0) out vec4 color;

void main() {
  vec3 d = normalize(ray);
  // Hills and woods, 3 km away and more, as far as the air lets them through.
  vec2 around = d.xy / max(length(d.xy), 1e-3);
  float woods = 0.004 + 0.005 * noise(around * 40.0 + 3.0) + 0.003 * noise(around * 170.0 + 5.0);
  float hills = 0.008 + 0.020 * noise(around * 5.0 + 9.0) + 0.006 * noise(around * 17.0 + 11.0);
  if (d.z < max(woods, hills)) {
    bool is_wood = d.z < woods;
    vec3 received = light.sky.rgb + 0.35 * light.sun.rgb;
    float passed = exp2(-(is_wood ? 3000.0 : 6000.0) * light.haze.w) * (is_wood ? 0.75 : 0.5);
    vec3 far = vec3(0.05, 0.07, 0.035) * (0.8 + 0.4 * noise(around * 300.0 + d.z * 900.0));
    color = vec4(film(mix(light.haze.rgb, far * received, passed)), 1.0);
    return;
  }
  float up = max(d.z, 0.0);
  vec3 radiance = mix(light.haze.rgb, light.zenith.rgb, pow(up, 0.45));
#ifdef SOFT
  vec2 p = d.xy / (up + 0.12);
  float cloud = noise(p * 1.3) + 0.5 * noise(p * 3.1 + 7.0) + 0.25 * noise(p * 6.7) - 0.875;
  radiance *= 1.0 + 0.25 * cloud * smoothstep(0.0, 0.15, up);
#elif !defined(NO_SUN)
  // The exposure opens to a low sun, whose whole light would leave no color in the sky.
  vec3 sun = light.sun.rgb * min(1.0, 4.0 / max(light.sun.r, 1e-3));
  // Fair-weather clouds.
  vec2 p = d.xy / (up + 0.08);
  float cloud = noise(p * 0.8 + 4.0) + 0.5 * noise(p * 1.9 + 7.0) + 0.25 * noise(p * 4.3) +
                0.12 * noise(p * 9.0) - 1.05;
  vec3 white = 0.62 * light.haze.rgb + 0.2 * dot(sun, vec3(0.333));
  radiance = mix(radiance, white, 0.5 * smoothstep(0.0, 0.35, cloud) * smoothstep(0.05, 0.2, up));
  float near = max(dot(d, light.sun_direction.xyz), 0.0);
  radiance += 0.25 * pow(near, 12.0) * sun + 3.0 * smoothstep(0.99985, 0.99995, near) * light.sun.rgb;
#endif
  color = vec4(film(radiance), 1.0);
}

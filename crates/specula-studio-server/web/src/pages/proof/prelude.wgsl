var<private> parameters: vec4f;

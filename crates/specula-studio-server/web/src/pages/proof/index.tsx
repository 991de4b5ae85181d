import type { Page } from '../page';

function Proof() {
  return <div class="page" />;
}

export const page: Page = {
  id: 'proof',
  title: 'Proof',
  summary: 'A BSDF of yours in WGSL: chi-square, normalisation, furnace, reciprocity.',
  component: Proof,
};

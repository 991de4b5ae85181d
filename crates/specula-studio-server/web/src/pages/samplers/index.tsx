import type { Page } from '../page';

function Samplers() {
  return <div class="page" />;
}

export const page: Page = {
  id: 'samplers',
  title: 'Samplers',
  summary: 'Where each sampler of visible normals puts its samples, what it rejects, and whether its density is what it says.',
  component: Samplers,
};

import type { Page } from '../page';

function Lobes() {
  return <div class="page" />;
}

export const page: Page = {
  id: 'lobes',
  title: 'Lobes',
  summary: 'Any lobe as curve and surface: value, density, albedo, random walks.',
  component: Lobes,
};
